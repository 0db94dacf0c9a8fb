"""How two networks differ at run time, ignoring the order and the layout of their files."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass

from hri.behavior.behavior import Behavior
from hri.behavior.board import BoardSink, BoardSource
from hri.behavior.catalog import type_of
from hri.behavior.network import Link, Network
from hri.behavior.network_layout import Layout, lay_out

ADDED, REMOVED, CHANGED, SAME = "added", "removed", "changed", "same"
"""Shades of a picture."""
HEADING = "green: added; red, dashed: removed; amber: changed"


@dataclass(frozen=True)
class NetworkDifference:
    """What the new network has beside the old one, and the other way around."""

    attributes: tuple[str, ...]
    """`name old -> new`, `interval 0.1 -> 0.05`."""
    added: tuple[str, ...]
    """Ids of behaviors."""
    removed: tuple[str, ...]
    changed: Mapping[str, tuple[str, ...]]
    """By the id of a behavior in both, its type and parameters that differ: `factor 1 -> 2`."""
    added_links: tuple[str, ...]
    """As `behavior.output -> behavior.input`."""
    removed_links: tuple[str, ...]

    @property
    def is_empty(self) -> bool:
        """Whether the two do the same."""
        return not (
            self.attributes
            or self.added
            or self.removed
            or self.changed
            or self.added_links
            or self.removed_links
        )

    def lines(self) -> list[str]:
        """In words, a difference a line, as `diff` marks them."""
        return [
            *(f"~ {one}" for one in self.attributes),
            *(f"- {id}" for id in self.removed),
            *(f"+ {id}" for id in self.added),
            *(f"~ {id}: {', '.join(what)}" for id, what in self.changed.items()),
            *(f"- {link}" for link in self.removed_links),
            *(f"+ {link}" for link in self.added_links),
        ]


def compare(old: Network, new: Network) -> NetworkDifference:
    """What differs between two networks."""
    before = {behavior.id: behavior for behavior in old.authored}
    after = {behavior.id: behavior for behavior in new.authored}
    links_before, links_after = ([str(link) for link in one.links] for one in (old, new))
    changed = {id: _changes(before[id], after[id]) for id in before if id in after}
    return NetworkDifference(
        attributes=_differing(
            {"name": old.name, "interval": f"{old.interval:g}"},
            {"name": new.name, "interval": f"{new.interval:g}"},
        ),
        added=tuple(id for id in after if id not in before),
        removed=tuple(id for id in before if id not in after),
        changed={id: what for id, what in changed.items() if what},
        added_links=tuple(link for link in links_after if link not in links_before),
        removed_links=tuple(link for link in links_before if link not in links_after),
    )


def _changes(before: Behavior, after: Behavior) -> tuple[str, ...]:
    names = dict.fromkeys((*_chosen(before), *_chosen(after)))
    return _differing(
        {"type": type_of(before), **_values(before, names)},
        {"type": type_of(after), **_values(after, names)},
    )


def _chosen(behavior: Behavior) -> list[str]:
    """The parameters that do not have their default."""
    declared = behavior.parameters.items()
    return [name for name, one in declared if getattr(behavior, name) != one.default]


def _values(behavior: Behavior, names: Iterable[str]) -> dict[str, str]:
    """Parameters as files have them."""
    known = behavior.parameters
    return {name: known[name].text(getattr(behavior, name)) for name in names if name in known}


def _differing(before: dict[str, str], after: dict[str, str]) -> tuple[str, ...]:
    names = dict.fromkeys((*before, *after))
    return tuple(
        f"{name} {before.get(name, 'none')} -> {after.get(name, 'none')}"
        for name in names
        if before.get(name) != after.get(name)
    )


def drawn_together(old: Network, new: Network, difference: NetworkDifference) -> Layout:
    """Both as one drawing, each part in the shade of what became of it."""
    union = Network(new.name, new.interval)
    union.behaviors = [*new.behaviors]
    known = {_key(one): one for one in union.behaviors}
    for behavior in old.behaviors:
        if _key(behavior) not in known:
            union.behaviors.append(behavior)
            known[_key(behavior)] = behavior
    gone = [link for link in old.links if str(link) in difference.removed_links]
    union.links = [*new.links, *(_between(known, link) for link in gone)]
    _sort(union)
    layout = lay_out(union, kind_of)
    for box in layout.boxes:
        assert box.behavior is not None, "only boxes are listed"
        box.shade = _shade_of(box.behavior, difference)
    for wire in layout.wires:
        text = str(wire.link)
        is_removed, is_added = text in difference.removed_links, text in difference.added_links
        wire.shade = REMOVED if is_removed else ADDED if is_added else SAME
    return layout


def _key(behavior: Behavior) -> tuple[str, bool]:
    """The two ends of the board have the same id."""
    return behavior.id, isinstance(behavior, BoardSink)


def _between(known: dict[tuple[str, bool], Behavior], link: Link) -> Link:
    source, target = known[_key(link.source)], known[_key(link.target)]
    return Link(source, link.output, target, link.input, link.place)


def _sort(union: Network) -> None:
    """Behaviors in dependency order: what the two make together may run in a circle."""
    placed: list[Behavior] = []
    rest = [*union.behaviors]
    while rest:
        ready = [
            one
            for one in rest
            if all(link.source not in rest for link in union.links if link.target is one)
        ]
        first = ready[0] if ready else rest[0]
        placed.append(first)
        rest.remove(first)
    union.behaviors = placed


def kind_of(behavior: Behavior) -> str:
    """The line below the id of a behavior in a picture."""
    return "slots" if isinstance(behavior, BoardSource | BoardSink) else type_of(behavior)


def _shade_of(behavior: Behavior, difference: NetworkDifference) -> str:
    shades = ((ADDED, difference.added), (REMOVED, difference.removed))
    known = next((shade for shade, ids in shades if behavior.id in ids), SAME)
    return CHANGED if behavior.id in difference.changed else known
