# SPDX-License-Identifier: BSD-3-Clause
"""What names say: which part stands still, of what one is made, and names that say nothing."""

from __future__ import annotations

import re

#: Words with which names of what stands still begin, in English, German and Dutch.
_GROUND = re.compile(
    r"(?:^|[^a-zäöüß])(ground|base|basis|bodem|boden|frame|fixed|fixture|fixation|grund|gestel|"
    r"rahmen|fest|fundament|chassis|sockel|stator|stationary|vast|grond|onderplaat|unterbau|"
    r"immobile|housing|geh(?:ä|ae)use|huis\b)",
    re.I,
)
#: Names that say nothing.
_NAMELESS = re.compile(
    r"^(body|part|solid|component|k(?:ö|oe)rper|teil|onderdeel|lichaam|volumenk(?:ö|oe)rper|"
    r"extrude|boss-extrude|import(?:ed)?|cut-extrude|fillet|pad|pocket)[ _.-]*\d*$|^$",
    re.I,
)
#: Words for materials in English, German and Dutch, and their names here; the first that fits.
_MATERIALS = [
    (re.compile(words, re.I), name)
    for words, name in (
        (r"spring ?steel|federstahl|verenstaal|50crv4|1\.8159|51crv4", "spring steel"),
        (r"tool ?steel|werkzeugstahl|gereedschapsstaal|h13|1\.2344", "tool steel"),
        (
            r"stainless|edelstahl|nichtrostend|\brvs\b|1\.43\d\d|1\.44\d\d|aisi ?3\d\d|inox",
            "stainless steel",
        ),
        (r"7075", "aluminium 7075-T6"),
        (r"alumini?um|\balu\b|en[ -]?aw|6061|6082|5083|almg", "aluminium"),
        (r"titan", "titanium"),
        (r"beryllium|cube2|c17200", "beryllium copper"),
        (r"\bpla\b", "PLA"),
        (r"pa ?12|nylon 12", "PA12"),
        (r"steel|stahl|staal|s235|s355|1\.0\d\d\d|c45", "steel"),
    )
]


def is_ground_name(name: str) -> bool:
    """Whether a name says that something stands still."""
    return bool(_GROUND.search(name))


def says_ground(name: str) -> bool:
    """Whether a name is that of the ground itself, which nothing that moves is called."""
    return name.lower().startswith("ground")


def begins_as_ground(name: str) -> bool:
    """Whether a name begins so: "base plate", and not "upper base"."""
    found = _GROUND.search(name)
    return found is not None and not any(c.isalpha() for c in name[: found.start(1)])


def says_nothing(name: str) -> bool:
    """Whether a name is one that CAD gives by itself."""
    return bool(_NAMELESS.match(name))


def known_material(words: str) -> str:
    """The material that Flexact knows for what a file calls it; "" for none."""
    return next((name for pattern, name in _MATERIALS if pattern.search(words)), "")
