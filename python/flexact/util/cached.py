# SPDX-License-Identifier: BSD-3-Clause
"""A property that is found once for each object, without a lock.

That of `functools` has one lock for all objects of a class in Python 3.10 and 3.11: a process that
is forked while another thread holds it waits for ever, and threads wait for each other. From 3.12
on it has none, and is taken. Two threads that ask at once both find it; the last is kept.
"""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING

if TYPE_CHECKING or sys.version_info >= (3, 12):
    from functools import cached_property
else:

    class cached_property:  # noqa: N801
        """As that of `functools` from Python 3.12 on."""

        def __init__(self, function):
            """Of a method."""
            self.function = function
            self.name = function.__name__
            self.__doc__ = function.__doc__
            self.__module__ = function.__module__

        def __set_name__(self, owner, name):
            """What it is called, where it is kept."""
            self.name = name

        def __get__(self, instance, owner=None):
            """What was found; kept in the object, it is not asked for here again."""
            if instance is None:
                return self
            found = self.function(instance)
            instance.__dict__[self.name] = found
            return found


__all__ = ["cached_property"]
