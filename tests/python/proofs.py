# SPDX-License-Identifier: BSD-3-Clause
"""What a build without FLINT leaves out: proofs, and words that depend on them; see left_out.py."""

import pytest
from known_models import twelve_trusses

import flexact

CAN_PROVE = flexact.analyse(twelve_trusses(), prove=True).proof is not None

#: Of tests that ask for a proof.
NEEDS_FLINT = pytest.mark.skipif(not CAN_PROVE, reason="this build has no FLINT")
