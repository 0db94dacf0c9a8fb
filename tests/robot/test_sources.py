"""What decides a run is known again, and named when it has changed."""

from hri.robot.sources import authored, changed, digests


def test_what_has_changed_is_named_also_what_has_come_and_gone(tmp_path):
    sources = [tmp_path / name for name in ("a.txt", "b.txt", "c.txt", "folder", "none")]
    for source in sources[:3]:
        source.write_text("as it was")
    (tmp_path / "folder" / "below").mkdir(parents=True)
    (tmp_path / "folder" / "below" / "app.toml").write_text("as it was")
    before = digests(sources)
    assert changed(before) == []
    (tmp_path / "folder" / "below" / "film.mp4").write_text("of a recording, say")
    (tmp_path / "folder" / "feelings.svg").write_text("of a recording, too")
    assert changed(before) == []
    sources[0].write_text("other")
    sources[1].unlink()
    sources[4].write_text("new")
    (tmp_path / "folder" / "below" / "app.toml").write_text("other")
    assert changed(before) == [str(tmp_path / one) for one in ("a.txt", "b.txt", "folder", "none")]


def test_the_authored_files_of_a_folder_that_is_gone_are_none(tmp_path):
    assert authored(tmp_path / "gone") == []
