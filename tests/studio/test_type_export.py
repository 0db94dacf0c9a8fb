"""The types that other programs read are those of the topics."""

import jsonschema
import pytest

from hri.core import paths
from hri.studio.api import openapi
from hri.studio.topics import TOPICS
from hri.studio.type_export import schema_of, typescript, typescript_of

TYPES = [
    (str, {"type": "string"}, "string"),
    (float | None, {"anyOf": [{"type": "number"}, {"type": "null"}]}, "number | null"),
    (list[float], {"type": "array", "items": {"type": "number"}}, "number[]"),
    (dict[str, int], {"type": "object", "additionalProperties": {"type": "integer"}}, None),
]


@pytest.mark.parametrize(("type", "schema", "words"), TYPES)
def test_a_type_is_the_same_in_other_languages(type, schema, words):
    assert schema_of(type) == schema
    assert typescript_of(type) == (words or "Record<string, number>")


def test_the_page_has_the_types_of_the_topics():
    file = paths.house() / "hri" / "studio" / "page" / "src" / "topics.ts"
    assert file.read_text() == typescript(), "python -m hri.studio.type_export > topics.ts"


def test_the_document_names_each_topic_and_its_schemas_are_sound():
    schemas = openapi()["components"]["schemas"]
    assert schemas["State"]["properties"].keys() == TOPICS.keys()
    for schema in schemas.values():
        jsonschema.Draft202012Validator.check_schema(schema)
