"""Which joint of a body a full name means: states name joints as their files do, lists by full names."""

from __future__ import annotations

import re
from collections.abc import Sequence

from .services import JointInfo, Listing


def full_joint_names(listing: Listing, topic: str, published: Sequence[str]) -> dict[str, int]:
    """{full name: index in `published`} of the joints below the body with those topics.

    A full name is the one in the file, with namespaces before it and, in a further copy of a model, a number behind it.
    Passive joints have no index. Nor have joints that cannot be distinguished: better none than a wrong one.
    """
    below = _below(listing, topic)
    digits = {full: len(full) - len(full.rstrip("0123456789")) for full in below}
    endings = {full[-count:] for full in below for count in range(1, digits[full] + 1) if full[-count] != "0"}
    readings = {number: _with_number(below, published, number) for number in ("", *endings)}
    readings = {number: reading for number, reading in readings.items() if reading}
    if not readings:
        return _by_elimination(below, published)
    if len(readings) > 1:
        names = [joint.name for joint in listing.joints]
        readings = {
            n: reading for n, reading in readings.items() if all(_explained(full, n, names) for full in reading)
        }
    return readings.popitem()[1] if len(readings) == 1 else {}


def _explained(full: str, number: str, names: Sequence[str]) -> bool:
    """Whether the name without that number, and with all lower ones, was taken when this joint was loaded."""
    if not number:
        return True
    before = {*names[: names.index(full)]}
    stem = full.removesuffix(number)
    return stem in before and all(f"{stem}{lower}" in before for lower in range(1, int(number)))


def _with_number(below: Sequence[str], published: Sequence[str], number: str) -> dict[str, int]:
    """The indices if that number is behind all names; empty: it cannot be."""
    found = {}
    for index, name in enumerate(published):
        fits = [full for full in below if ("/" + full).endswith(f"/{name}{number}")]
        if len(fits) != 1 or fits[0] in found:
            return {}
        found[fits[0]] = index
    return found


def _by_elimination(below: Sequence[str], published: Sequence[str]) -> dict[str, int]:
    """The numbers differ: those go first for which only one index is possible, which no other claims."""
    possible = {
        full: [i for i, name in enumerate(published) if re.fullmatch(rf"(.*/)?{re.escape(name)}([1-9]\d*)?", full)]
        for full in below
    }
    known: dict[str, int] = {}
    while True:
        only = {full: fits[0] for full, fits in possible.items() if len(fits) == 1}
        claims = [*only.values()]
        sure = {full: i for full, i in only.items() if claims.count(i) == 1}
        if not sure:
            return known
        known |= sure
        taken = {*sure.values()}
        possible = {full: [i for i in fits if i not in taken] for full, fits in possible.items() if full not in known}


def _below(listing: Listing, topic: str) -> list[str]:
    """Full names of all joints below a body."""
    by_parent: dict[str, list[JointInfo]] = {}
    for joint in listing.joints:
        by_parent.setdefault(joint.parent, []).append(joint)
    ahead = [each.name for each in listing.objects if each.topic == topic]
    seen, found = {*ahead}, []
    while ahead:
        for joint in by_parent.get(ahead.pop(), ()):
            found.append(joint.name)
            if joint.child not in seen:
                seen.add(joint.child)
                ahead.append(joint.child)
    return found
