"""What else may have been said, and when each word was."""

from __future__ import annotations

from hypothesis import given, strategies as st

from hri.speech.recognizers.ctc.lattice import Path, Walk
from hri.speech.recognizers.ctc.phone_graph import compile
from hri.speech.recognizers.ctc.search import Search
from tests.speech.recognizers.word_graphs import Sounds, random_scores, sentence_graph, spelled

SENTENCES = ("go a goal", "go a go", "no no", "add gogo", "a")


def paths_of(scores, most: int = 9, beam: float = 1000.0) -> list[Path]:
    search = Search(compile(sentence_graph(*SENTENCES), Sounds()))
    search.advance(scores)
    return Walk(search.trellis).sentences(most, beam)


def test_every_sentence_that_fits_is_found_once_best_first() -> None:
    paths = paths_of(random_scores(1, 12))
    assert sorted(" ".join(path.words) for path in paths) == sorted(SENTENCES)
    scores = [path.score for path in paths]
    assert scores == sorted(scores, reverse=True)


def test_no_more_are_found_than_are_wanted() -> None:
    assert len(paths_of(random_scores(1, 12), most=2)) == 2


@given(st.integers(0, 2**32 - 1), st.integers(1, 12), st.floats(0, 20))
def test_none_is_worse_than_the_beam_allows(seed: int, frames: int, beam: float) -> None:
    paths = paths_of(random_scores(seed, frames), beam=beam)
    assert all(path.score >= paths[0].score - beam - 0.1 for path in paths)


def test_a_sentence_that_needs_more_frames_than_there_are_is_not_found() -> None:
    assert [path.words for path in paths_of(spelled("EY"))] == [("a",)]
    assert paths_of(spelled()) == []


def test_words_begin_with_their_first_phone_and_lie_side_by_side() -> None:
    silence = ["blank"] * 3
    sound = spelled(*silence, "G", "blank", "OW", *silence, "EY", *silence, "G", "OW", *silence)
    best = paths_of(sound)[0]
    assert best.words == ("go", "a", "go")
    assert [(span.start, span.end) for span in best.spans] == [(3, 9), (9, 13), (13, 18)]
    assert [sum(state >= 0 for state in span.states) for span in best.spans] == [2, 1, 2]
