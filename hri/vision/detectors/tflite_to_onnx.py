"""A network of a TensorFlow Lite file as an ONNX file, which onnxruntime runs.

OpenCV reads TensorFlow Lite by itself, but takes three to five times as long for these networks:
it has no fast path for a convolution of 5 by 5 pixels of each channel by itself. The operations are
those of MediaPipe's networks of faces and hands. A picture has its channels last there, and first
in ONNX.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from hri.vision.detectors import onnx_file
from hri.vision.detectors.onnx_file import Attribute
from hri.vision.detectors.tflite import Fields, Operation, TfliteNetwork, read_tflite

Array = NDArray[Any]

CHANNELS_FIRST, CHANNELS_LAST = (0, 3, 1, 2), (0, 2, 3, 1)
ADD, CONCATENATION, CONVOLUTION, DEPTHWISE, DEQUANTIZE = 0, 2, 3, 4, 6
DENSE, LOGISTIC, MAX_POOL, RELU, RELU_6 = 9, 14, 17, 19, 21
RESHAPE, RESIZE, PAD, MEAN, PRELU = 22, 23, 34, 40, 54
"""Numbers of operations, BuiltinOperator of the schema."""
ACTIVATION = {ADD: 0, CONCATENATION: 1, CONVOLUTION: 3, DEPTHWISE: 4, DENSE: 0, MAX_POOL: 5}
"""Which field of their options says what follows: nothing, or one of these."""
NONE, THEN_RELU, THEN_RELU_6 = 0, 1, 3
VALID = 1
"""Padding: none."""


def onnx_of(content: bytes) -> bytes:
    """The ONNX file of a TensorFlow Lite file; its outputs are in the same order.

    Raises ValueError for an operation that none of our networks has.
    """
    return _Conversion(read_tflite(content)).file()


class _Conversion:
    def __init__(self, network: TfliteNetwork) -> None:
        self._network = network
        self._values = {
            number: tensor.constant
            for number, tensor in enumerate(network.tensors)
            if tensor.constant is not None
        }
        self._nodes: list[bytes] = []
        self._constants: list[bytes] = []
        self._steps: dict[int, Callable[[Operation, Fields, str], None]] = {
            ADD: self._add,
            CONCATENATION: self._concatenate,
            CONVOLUTION: self._convolve,
            DEPTHWISE: self._convolve,
            DENSE: self._multiply,
            LOGISTIC: self._sigmoid,
            MAX_POOL: self._pool,
            RELU: self._relu,
            RELU_6: self._relu_6,
            RESHAPE: self._reshape,
            RESIZE: self._resize,
            PAD: self._pad,
            MEAN: self._mean,
            PRELU: self._prelu,
        }

    def file(self) -> bytes:
        for step in self._network.operations:
            self._convert(step)
        inputs, outputs = (
            [onnx_file.tensor(_name(number), self._shape(number)) for number in numbers]
            for numbers in (self._network.inputs, self._network.outputs)
        )
        return onnx_file.model(self._nodes, self._constants, inputs, outputs)

    def _convert(self, step: Operation) -> None:
        if step.code == DEQUANTIZE:  # weights of half precision
            self._values[step.output] = self._values[step.inputs[0]].astype(np.float32)
            return
        if step.code not in self._steps:
            raise ValueError(f"operation {step.code} of TensorFlow Lite is not known")
        options, output = step.options or Fields(bytes(8), 4), _name(step.output)
        follows = options.number(ACTIVATION[step.code], "b") if step.code in ACTIVATION else NONE
        if follows == NONE:
            self._steps[step.code](step, options, output)
            return
        between = f"{output} before"
        self._steps[step.code](step, options, between)
        if follows == THEN_RELU:
            self._node("Relu", [between], output)
        elif follows == THEN_RELU_6:
            self._clip(between, output)
        else:
            raise ValueError(f"activation {follows} of TensorFlow Lite is not known")

    # --- operations ---

    def _add(self, step: Operation, options: Fields, output: str) -> None:
        self._node("Add", map(_name, step.inputs), output)

    def _concatenate(self, step: Operation, options: Fields, output: str) -> None:
        axis, shape = options.number(0), self._shape(step.output)
        first = CHANNELS_FIRST.index(axis % 4) if len(shape) == 4 else axis
        self._node("Concat", map(_name, step.inputs), output, axis=first)

    def _convolve(self, step: Operation, options: Fields, output: str) -> None:
        is_depthwise = step.code == DEPTHWISE
        weights = self._values[step.inputs[1]]
        # As the file has them: [outputs, rows, columns, inputs], or [1, rows, columns, channels].
        weights = weights.transpose(3, 0, 1, 2) if is_depthwise else weights.transpose(0, 3, 1, 2)
        strides = options.number(2), options.number(1)
        self._node(
            "Conv",
            [_name(step.inputs[0]), *map(self._known, (weights, self._values[step.inputs[2]]))],
            output,
            group=len(weights) if is_depthwise else 1,
            strides=strides,
            pads=self._pads(step, options, weights.shape[2:], strides),
        )

    def _multiply(self, step: Operation, options: Fields, output: str) -> None:
        weights, flat = self._values[step.inputs[1]], f"{output} of"
        self._node("Flatten", [_name(step.inputs[0])], flat)
        known = map(self._known, (weights.T, self._values[step.inputs[2]]))
        self._node("Gemm", [flat, *known], output)

    def _sigmoid(self, step: Operation, options: Fields, output: str) -> None:
        self._node("Sigmoid", [_name(step.inputs[0])], output)

    def _pool(self, step: Operation, options: Fields, output: str) -> None:
        strides, kernel = (
            (options.number(2), options.number(1)),
            (options.number(4), options.number(3)),
        )
        pads = self._pads(step, options, kernel, strides)
        self._node(
            "MaxPool",
            [_name(step.inputs[0])],
            output,
            kernel_shape=kernel,
            strides=strides,
            pads=pads,
        )

    def _relu(self, step: Operation, options: Fields, output: str) -> None:
        self._node("Relu", [_name(step.inputs[0])], output)

    def _relu_6(self, step: Operation, options: Fields, output: str) -> None:
        self._clip(_name(step.inputs[0]), output)

    def _reshape(self, step: Operation, options: Fields, output: str) -> None:
        source = _name(step.inputs[0])
        if len(self._shape(step.inputs[0])) == 4:
            self._node("Transpose", [source], f"{source} last", perm=CHANNELS_LAST)
            source = f"{source} last"
        shape = np.array(self._network.tensors[step.output].shape, np.int64)
        self._node("Reshape", [source, self._known(shape)], output)

    def _resize(self, step: Operation, options: Fields, output: str) -> None:
        mode = "half_pixel" if options.number(3, "b") else "asymmetric"
        if options.number(2, "b"):
            mode = "align_corners"
        sizes = self._known(np.array(self._shape(step.output), np.int64))
        self._node(
            "Resize",
            [_name(step.inputs[0]), "", "", sizes],
            output,
            mode="linear",
            coordinate_transformation_mode=mode,
        )

    def _pad(self, step: Operation, options: Fields, output: str) -> None:
        pads = self._values[step.inputs[1]][list(CHANNELS_FIRST)].T.ravel()
        self._node("Pad", [_name(step.inputs[0]), self._known(pads)], output)

    def _mean(self, step: Operation, options: Fields, output: str) -> None:
        axes = [CHANNELS_FIRST.index(axis) for axis in self._values[step.inputs[1]].ravel()]
        keeps = options.number(0, "b")
        self._node("ReduceMean", [_name(step.inputs[0])], output, axes=axes, keepdims=keeps)

    def _prelu(self, step: Operation, options: Fields, output: str) -> None:
        slopes = self._values[step.inputs[1]].reshape(-1, 1, 1)
        self._node("PRelu", [_name(step.inputs[0]), self._known(slopes)], output)

    # --- parts ---

    def _clip(self, source: str, output: str) -> None:
        low, high = (self._known(np.float32(edge)) for edge in (0, 6))
        self._node("Clip", [source, low, high], output)

    def _node(self, operation: str, inputs: Any, output: str, **attributes: Attribute) -> None:
        self._nodes.append(onnx_file.node(operation, inputs, output, attributes))

    def _known(self, values: Any) -> str:
        """A constant's name."""
        name = f"constant {len(self._constants)}"
        self._constants.append(onnx_file.constant(name, np.asarray(values)))
        return name

    def _shape(self, number: int) -> Sequence[int]:
        shape = self._network.tensors[number].shape
        return [shape[axis] for axis in CHANNELS_FIRST] if len(shape) == 4 else shape

    def _pads(
        self, step: Operation, options: Fields, kernel: Sequence[int], strides: Sequence[int]
    ) -> list[int]:
        """Pixels above, at the left, below, and at the right; of an odd sum most come last."""
        if options.number(0, "b") == VALID:
            return [0, 0, 0, 0]
        missing = [
            max(0, (-(-length // stride) - 1) * stride + size - length)
            for length, size, stride in zip(
                self._shape(step.inputs[0])[2:], kernel, strides, strict=True
            )
        ]
        return [*(pixels // 2 for pixels in missing), *(-(-pixels // 2) for pixels in missing)]


def _name(number: int) -> str:
    return f"tensor {number}"
