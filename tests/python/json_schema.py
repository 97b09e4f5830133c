# SPDX-License-Identifier: BSD-3-Clause
"""The schemas of the JSON, as tests hold outputs against them: nothing but what they name."""

import copy
import json
from pathlib import Path
from typing import Any

import jsonschema

DOCS = Path(__file__).parents[2] / "docs"


def schema(name: str = "result") -> dict[str, Any]:
    text = (DOCS / f"{name}.schema.json").read_text(encoding="utf-8")
    content: dict[str, Any] = json.loads(text)
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
STORED = jsonschema.Draft202012Validator(strict(schema("stored_answer")))


def assert_valid(made: dict[str, Any]) -> None:
    """An output is what the schema says, and no more."""
    assert_valid_as(FAILURE if "error" in made else RESULT, made)


def assert_valid_as(of: Any, made: dict[str, Any]) -> None:
    wrong = [f"{each.json_path}: {each.message[:300]}" for each in of.iter_errors(made)]
    assert not wrong, wrong[:5]
