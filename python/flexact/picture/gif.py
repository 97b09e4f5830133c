"""Frames as a GIF that runs without end, all in one palette."""

from __future__ import annotations

import io

import numpy as np

#: Colours of the palette: so many that occur most, as they are, and so many for the rest.
_KEPT, _MIXED = 64, 96


def gif_of(drawings: list[np.ndarray], order: list[int], duration: int) -> bytes:
    """Drawings (height, width, 3) of 8 bits a colour as frames, each shown so long [ms].

    `order` says which drawing each frame shows.

    One palette and no dithering: colours stay what and where they are from frame to frame.
    """
    from PIL import Image

    packed = [_packed(drawing) for drawing in drawings]
    palette = _palette(packed)
    table = _table(packed, palette)
    made = []
    for each in packed:
        image = Image.fromarray(table[each])
        image.putpalette(palette.ravel().tolist())
        made.append(image)
    buffer = io.BytesIO()
    made = [made[k] for k in order]
    made[0].save(
        buffer,
        format="GIF",
        save_all=True,
        append_images=made[1:],
        duration=duration,
        loop=0,
        optimize=False,
        disposal=1,
    )
    return buffer.getvalue()


def _packed(frame: np.ndarray) -> np.ndarray:
    """(height, width) one number a colour."""
    wide = frame.astype(np.int32)
    return np.asarray((wide[..., 0] << 16) | (wide[..., 1] << 8) | wide[..., 2])


def _unpacked(colours: np.ndarray) -> np.ndarray:
    return np.stack([(colours >> shift) & 255 for shift in (16, 8, 0)], axis=-1)


def _palette(packed: list[np.ndarray]) -> np.ndarray:
    """(n, 3) colours for some of the frames, and so for all."""
    from PIL import Image

    some = np.concatenate([each.ravel() for each in packed[:: max(1, len(packed) // 4)]])
    colours, counts = np.unique(some, return_counts=True)
    kept = colours[np.argsort(-counts, kind="stable")[:_KEPT]]
    rest = some[~np.isin(some, kept)]
    if not rest.size:
        return _unpacked(kept).astype(np.uint8)
    line = Image.fromarray(_unpacked(rest)[None].astype(np.uint8))
    mixed = line.quantize(_MIXED, method=Image.Quantize.MEDIANCUT, dither=Image.Dither.NONE)
    given = np.array(mixed.getpalette(), np.uint8).reshape(-1, 3)
    return np.concatenate((_unpacked(kept).astype(np.uint8), given))[: _KEPT + _MIXED]


def _table(packed: list[np.ndarray], palette: np.ndarray) -> np.ndarray:
    """(2**24,) the index of the nearest colour of the palette, for all colours there are."""
    there = np.zeros(1 << 24, bool)
    for each in packed:
        there[each] = True
    colours = np.flatnonzero(there)
    table = np.zeros(1 << 24, np.uint8)
    given = palette.astype(np.int32)
    for part in np.array_split(colours, len(colours) // 4096 + 1):
        offset = _unpacked(part).astype(np.int32)[:, None] - given
        table[part] = np.argmin(np.sum(offset**2, axis=-1), axis=1)
    return table
