# SPDX-License-Identifier: BSD-3-Clause
"""What a person sees: drawings, charts, pictures, pages, meshes and notebooks."""
