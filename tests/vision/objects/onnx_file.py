"""A network in the ONNX format, written by hand: the mean color of a picture."""


def mean_color_network() -> bytes:
    """Input [1, 3, 224, 224], output [1, 3, 1, 1]: a model with the node GlobalAveragePool."""
    node = _text(1, "picture") + _text(2, "mean") + _text(4, "GlobalAveragePool")
    graph = (
        _part(1, node)
        + _text(2, "colors")
        + _part(11, _tensor("picture", (1, 3, 224, 224)))
        + _part(12, _tensor("mean", (1, 3, 1, 1)))
    )
    return _number(1, 8) + _part(7, graph) + _part(8, _number(2, 13))


def _tensor(name: str, shape: tuple[int, ...]) -> bytes:
    sizes = b"".join(_part(1, _number(1, side)) for side in shape)
    float_tensor = _number(1, 1) + _part(2, sizes)
    return _text(1, name) + _part(2, _part(1, float_tensor))


def _text(field: int, text: str) -> bytes:
    return _part(field, text.encode())


def _part(field: int, content: bytes) -> bytes:
    return _varint(field << 3 | 2) + _varint(len(content)) + content


def _number(field: int, value: int) -> bytes:
    return _varint(field << 3) + _varint(value)


def _varint(value: int) -> bytes:
    """Protocol buffers: seven bits a byte, the lowest first."""
    return bytes([value]) if value < 128 else bytes([value & 127 | 128]) + _varint(value >> 7)
