"""What must hold between networks that run together: one writer of a drive, one type of a slot."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass

from hri.behavior.board import DECLARED, BoardSink, BoardSource
from hri.behavior.library.sharing import Share, Shared
from hri.behavior.network import Link, Network, Remark
from hri.behavior.ports import ANY, GENERIC, means_same
from hri.core.errors import AuthoringError


@dataclass(frozen=True)
class SlotUse:
    """A link that reads or writes a slot of the board."""

    slot: str
    writes: bool
    network: Network
    link: Link
    port: str
    """The other end of the link: `behavior.port`."""
    datatype: str
    semantic: str

    def __str__(self) -> str:
        return f"{self.network.name}.{self.port}"


def slot_uses(networks: Iterable[Network]) -> list[SlotUse]:
    """All links of networks that read or write slots, in the order of the files."""
    return [use for network in networks for link in network.links for use in _uses(network, link)]


def _uses(network: Network, link: Link) -> Iterator[SlotUse]:
    source, target = link.source, link.target
    sends, takes = source.outputs[link.output], target.inputs[link.input]
    reads = {BoardSource: link.output, Shared: getattr(source, "slot", "")}.get(type(source))
    writes = {BoardSink: link.input, Share: getattr(target, "slot", "")}.get(type(target))
    if reads is not None:
        port = f"{target.id}.{link.input}"
        yield SlotUse(reads, False, network, link, port, takes.datatype, takes.semantic)
    if writes is not None:
        port = f"{source.id}.{link.output}"
        yield SlotUse(writes, True, network, link, port, sends.datatype, sends.semantic)


def slot_table(
    networks: Iterable[Network],
) -> tuple[dict[str, list[str]], dict[str, list[str]], dict[str, str]]:
    """Writers, readers and datatype of each slot, by its name."""
    networks = list(networks)
    writers: dict[str, list[str]] = {}
    readers: dict[str, list[str]] = {}
    datatypes: dict[str, str] = {}
    for use in slot_uses(networks):
        (writers if use.writes else readers).setdefault(use.slot, []).append(str(use))
        if datatypes.get(use.slot, ANY) == ANY:
            datatypes[use.slot] = use.datatype
    for network in networks:
        for behavior in network.behaviors:
            slot = getattr(behavior, "slot", "")
            if slot and not isinstance(behavior, Share | Shared):
                readers.setdefault(slot, []).append(f"{network.name}.{behavior.id}")
                datatypes.setdefault(slot, ANY)
    known = {slot: DECLARED[slot].datatype for slot in datatypes if slot in DECLARED}
    return writers, readers, datatypes | known


def check_together(networks: Iterable[Network]) -> None:
    """Raise AuthoringError where networks contradict each other; warn where they may."""
    networks = list(networks)
    _refuse_second_writers(networks)
    _check_slots(networks)


def _refuse_second_writers(networks: list[Network]) -> None:
    """Raise AuthoringError where two behaviors steer one drive with the same rank."""
    steering: dict[tuple[str, str], str] = {}
    for network in networks:
        for behavior in network.behaviors:
            if behavior.steers is None:
                continue
            place = f'"{behavior.id}" ({network.place_of(behavior)})'
            other = steering.setdefault(behavior.steers, place)
            if other != place:
                drive, rank = behavior.steers
                what = f'"{behavior.id}" steers "{drive}" with the rank "{rank}", as {other} does'
                remedy = "take one out, put an Hri.PriorityArbiter before one, or change its rank"
                raise AuthoringError(network.place_of(behavior), what, remedy)


def _check_slots(networks: list[Network]) -> None:
    """Raise AuthoringError where a slot is used with two datatypes; warn of two meanings."""
    typed: dict[str, tuple[str, str]] = {
        slot.name: (slot.datatype, f"here it is {slot.about}") for slot in DECLARED.values()
    }
    meant: dict[str, SlotUse] = {}
    for use in slot_uses(networks):
        if use.datatype != ANY:
            datatype, where = typed.setdefault(use.slot, (use.datatype, f"{use}, {use.link.place}"))
            if datatype != use.datatype:
                what = f"board.{use.slot} is {datatype} ({where}), but {use.port} is {use.datatype}"
                raise AuthoringError(use.link.place, what, "link ports of the same datatype")
        if use.semantic != GENERIC:
            other = meant.setdefault(use.slot, use)
            if not means_same(other.semantic, use.semantic):
                what = f"{use.port} means {use.semantic}, {other} means {other.semantic}"
                use.network.warnings.append(Remark(use.link.place, f"board.{use.slot}: {what}"))
