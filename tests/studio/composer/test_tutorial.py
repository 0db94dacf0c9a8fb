"""The composer of 2003 in a browser: its tutorial is built and runs, and one looks into it."""

import re

import pytest

from hri.behavior.network_file import load_network
from hri.behavior.network_writer import write_network
from hri.cli.behave import main as behave
from tests.studio.browser import NEEDS_BROWSER

pytest.importorskip("playwright", reason="no playwright - pip install hri[dev]")
from playwright.sync_api import expect

from tests.studio.composer.hands import TUTORIAL, Composer

pytestmark = NEEDS_BROWSER


@pytest.mark.proves("V01", "V03")
@pytest.mark.slow
def test_the_tutorial_of_the_guide_is_built_and_runs(studio, page, capsys):
    hands = Composer(page)
    hands.new("objrec")
    hands.drag_behavior("Camera")
    hands.set("camera_id", "camera")
    hands.drag_behavior("ImageDisplay")
    hands.link("camera.raw_image", "image_display.image")
    hands.save()
    hands.drag_behavior("ObjRecRecognizer")
    hands.set("modelset", "default.mdl")
    hands.link("camera.raw_image", "obj_rec_recognizer.image")
    hands.drag_behavior("InputCollector")
    hands.set("print_input", "true")
    hands.link("obj_rec_recognizer.model_name", "input_collector.input")
    hands.link("obj_rec_recognizer.distance", "input_collector.input")
    hands.save()
    hands.drag_behavior("Constant")
    hands.set("parsed_value", "80")
    hands.drag_behavior("Subtraction")
    hands.link("obj_rec_recognizer.distance", "subtraction.input_positive")
    hands.link("constant.value", "subtraction.input_negative")
    hands.drag_behavior("DriveSystem")
    hands.set("drive_id", "drive")
    hands.link("subtraction.difference", "drive_system.linear_velocity")
    hands.save()
    assert hands.actions <= 60
    expect(page.locator(".part.broken")).to_have_count(0)
    file = studio.home / "objrec.xml"
    network = load_network(file)
    assert write_network(network) == file.read_text(), "as hri network format writes it"
    assert re.sub(r"  <Layout>.*</Layout>\n", "", file.read_text(), flags=re.DOTALL) == TUTORIAL
    assert network.boxes.keys() == {one.id for one in network.authored}
    capsys.readouterr()
    assert behave([str(file), "--config", "simulated", "--duration=3", "--fast"]) == 0
    assert "dollar_front.jpg" in capsys.readouterr().out


@pytest.mark.proves("V01")
def test_it_runs_pauses_ticks_and_says_why(studio, page):
    file = studio.home / "run.xml"
    file.write_text(
        """<BehaviorNetwork>
  <Behavior id="three" type="Hri.Constant"><Parameter name="parsed_value" value="3"/></Behavior>
  <Behavior id="zero" type="Hri.Scale"><Parameter name="factor" value="0"/></Behavior>
  <Behavior id="end" type="Hri.InputCollector"/>
  <Link from="three.value" to="zero.input"/>
  <Link from="zero.scaled" to="end.input"/>
</BehaviorNetwork>
"""
    )
    hands = Composer(page)
    hands.open(file)
    page.get_by_role("button", name="Start", exact=True).click()
    expect(page.locator("[data-value='three.value']")).to_have_text("3")
    expect(hands.part("zero").locator(".cost")).to_contain_text("µs")
    hands.part("zero").click()
    page.get_by_role("button", name="Why this value?").last.click()
    expect(page.locator(".why")).to_contain_text("three.value")
    page.locator(".why").get_by_role("button", name="Close").click()
    page.get_by_role("button", name="Break when…").click()
    page.fill("#condition", "<= 0")
    page.keyboard.press("Enter")
    expect(page.locator(".run-bar .hit")).to_contain_text("zero.scaled <= 0: 0")
    expect(page.locator(".run-bar")).to_contain_text("paused")
    ticks = re.search(r"(\d+) ticks", page.locator(".run-bar").inner_text())[1]
    page.get_by_role("button", name="One tick").click()
    expect(page.locator(".run-bar")).to_contain_text(f"{int(ticks) + 1} ticks")
    page.get_by_role("button", name="End", exact=True).click()
    expect(page.locator(".run-bar")).to_contain_text("it does not run")
