"""The command ``flexact``: one module a verb."""

from flexact.cli.main import main

__all__ = ["main"]
