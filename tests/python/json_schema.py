# SPDX-License-Identifier: BSD-3-Clause
"""The schema of the JSON, as tests hold outputs against it: nothing but what it names."""

import copy
import json
from pathlib import Path
from typing import Any

import jsonschema

SCHEMA = Path(__file__).parents[2] / "docs" / "result.schema.json"


def schema() -> dict[str, Any]:
    content: dict[str, Any] = json.loads(SCHEMA.read_text(encoding="utf-8"))
    return content


def strict(part: Any) -> Any:
    """The schema with objects closed, so that a name that it lacks is a mistake."""
    if isinstance(part, dict):
        made = {key: strict(value) for key, value in part.items()}
        return {**made, "additionalProperties": False} if made.get("type") == "object" else made
    return [strict(each) for each in part] if isinstance(part, list) else part


def validator(of: str) -> Any:
    """Of "result" or "failure", so that what is wrong is told at its place."""
    closed = strict(copy.deepcopy(schema()))
    del closed["oneOf"]
    return jsonschema.Draft202012Validator({**closed, "$ref": f"#/$defs/{of}"})


RESULT, FAILURE = validator("result"), validator("failure")


def assert_valid(made: dict[str, Any]) -> None:
    """An output is what the schema says, and no more."""
    of = FAILURE if "error" in made else RESULT
    wrong = [f"{each.json_path}: {each.message[:300]}" for each in of.iter_errors(made)]
    assert not wrong, wrong[:5]
