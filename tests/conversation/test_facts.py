"""What a sentence with `@remember` tells."""

from typing import Any

import pytest

from hri.conversation.facts import fact_of


@pytest.mark.parametrize(
    ("tags", "fact"),
    [
        ({"value": "jazz"}, ("jazz", {})),
        ({"likes": "jazz", "kind": "music"}, ("jazz", {"kind": "music"})),
        ({"value": "May third", "date": "--05-03"}, ("May third", {"date": "--05-03"})),
        ({"thing": "jazz", "level": 3}, ("jazz", {"level": 3})),
        ({"thing": "jazz", "kind": "music"}, ("", {})),
        ({"value": 3.0}, ("", {})),
        ({"thing": "jazz", "parts": [1, 2]}, ("jazz", {})),
        ({}, ("", {})),
    ],
)
def test_the_words_and_the_values_of_a_fact(tags: dict[str, Any], fact: tuple[str, dict]) -> None:
    assert fact_of("likes", tags) == fact
