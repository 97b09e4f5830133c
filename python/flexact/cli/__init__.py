"""The command ``flexact``: one module a verb."""
