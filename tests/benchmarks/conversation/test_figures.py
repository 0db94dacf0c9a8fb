from benchmarks.conversation import figures
from tests.benchmarks.conversation.talks import line


def test_the_table_counts_by_writer_and_kind():
    lines = [
        line(1, "Hello!", rule="greet"),
        line(2, writer="bob", kind="follow-up"),
        line(3, "Yes?", expects="stays silent: they talk to each other"),
        line(4, expects="stays silent: they talk to each other"),
    ]
    heading, *rows = figures.table(lines)
    assert heading.split()[:3] == ["turns", "understood", "answered"]
    counts = {row.split()[0]: [int(word) for word in row.split() if word.isdigit()] for row in rows}
    assert counts["all"] == [4, 1, 2, 1, 1]
    assert counts["ann"] == [3, 1, 2, 0, 1]
    assert counts["bob"] == counts["follow-up"] == [1, 0, 0, 1, 0]


def test_a_reply_is_said_again_within_five_minutes_of_one_life():
    lines = [
        line(1, "Hello!"),
        line(2, "Yes."),
        line(3, "Hello!"),
        line(60, "Yes."),
        line(61, "Hello!", id="open/ann/2/1"),
    ]
    assert figures.repeated(lines) == (["Hello!"], 5)
    assert figures.told_again(lines).endswith("1 (20 %) of 5")
    assert figures.told_again([]).endswith("- of 0")


def test_an_intent_is_understood_in_all_sentences_or_in_one():
    lines = [
        line(1, kind="dance", rule="dance"),
        line(2, kind="dance"),
        line(3, kind="time", rule="time"),
        line(4, kind="weather"),
    ]
    assert figures.intents_understood(lines) == (1, 2, 3)
