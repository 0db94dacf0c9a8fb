"""The recordings that are part of the project."""

from tests.recorded import HERE, manifest

FREE = {"Apache-2.0", "BSD-2-Clause", "CC0-1.0", "MIT"}


def test_every_recording_is_listed_with_its_source_and_a_license_that_lies_beside_it() -> None:
    rows = manifest()
    here = {
        path.relative_to(HERE).as_posix()
        for path in HERE.glob("*/*")
        if path.suffix in (".flac", ".jpg", ".npz")
    }
    assert [row["file"] for row in rows] == list(dict.fromkeys(row["file"] for row in rows))
    assert {row["file"] for row in rows} == here
    assert all(row["transcript"] and row["source"] for row in rows)
    assert {row["license"] for row in rows} == FREE | {"public domain"}
    assert all((HERE / f"LICENSE.{license}").is_file() for license in FREE)


def test_they_are_small() -> None:
    assert sum(path.stat().st_size for path in HERE.rglob("*.*")) < 2_200_000
