"""The built-in hands agree with the published JSON schema, and the schema refuses what is wrong."""

import copy
import json
import os
import pathlib

import jsonschema
import pytest

HANDS = pathlib.Path(os.environ["PALPATE_SOURCE"]) / "data/hands"
SCHEMA = json.loads((HANDS / "hand.schema.json").read_text())
FILES = sorted(HANDS.glob("*/hand.json"))


def test_there_are_hands():
    assert len(FILES) >= 5


@pytest.mark.parametrize("path", FILES, ids=lambda path: path.parent.name)
def test_built_in_hands_agree_with_the_schema(path):
    jsonschema.validate(json.loads(path.read_text()), SCHEMA)


@pytest.mark.parametrize(
    "change",
    [
        lambda hand: hand.pop("full_scale"),
        lambda hand: hand.update(colour="blue"),
        lambda hand: hand["matrices"][0].update(rows=0),
        lambda hand: hand["matrices"][0].update(mask=["x"]),
        lambda hand: hand["matrices"][0]["surface"].pop("x_axis"),
        lambda hand: hand["axes"][0].update(unit="m"),
        lambda hand: hand.update(matrices=[]),
    ],
)
def test_the_schema_refuses_what_the_program_refuses(change):
    hand = copy.deepcopy(json.loads((HANDS / "sdh2/hand.json").read_text()))
    change(hand)
    with pytest.raises(jsonschema.ValidationError):
        jsonschema.validate(hand, SCHEMA)
