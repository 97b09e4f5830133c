"""Analyses with the vectors of their smallest singular values, by NumPy."""

import dataclasses

import numpy as np

from flexact import Analysis


def with_pairs(analysis: Analysis, most: int = 6) -> Analysis:
    """The same analysis with pairs of the scaled D(c) from `numpy.linalg.svd`."""
    raw = analysis.raw
    scaled = raw.row_scale[:, None] * analysis.dense_jacobian() * raw.column_scale
    left, values, right = np.linalg.svd(scaled)
    chosen = list(range(raw.rank))[::-1][:most]
    pairs = {
        "pair_value": values[chosen],
        "pair_motion": right[chosen].T,
        "pair_stress": left[:, chosen],
    }
    return dataclasses.replace(analysis, raw=raw._replace(**pairs))
