"""The hands of a person in the composer."""

import os

from playwright.sync_api import expect

TUTORIAL = """<?xml version="1.0" encoding="UTF-8"?>
<BehaviorNetwork>
  <Behavior id="camera" type="Hri.Camera">
    <Parameter name="camera_id" value="camera"/>
  </Behavior>
  <Behavior id="image_display" type="Hri.ImageDisplay"/>
  <Behavior id="obj_rec_recognizer" type="Hri.ObjRecRecognizer">
    <Parameter name="modelset" value="default.mdl"/>
  </Behavior>
  <Behavior id="input_collector" type="Hri.InputCollector">
    <Parameter name="print_input" value="true"/>
  </Behavior>
  <Behavior id="constant" type="Hri.Constant">
    <Parameter name="parsed_value" value="80"/>
  </Behavior>
  <Behavior id="subtraction" type="Hri.Subtraction"/>
  <Behavior id="drive_system" type="Hri.DriveSystem">
    <Parameter name="drive_id" value="drive"/>
  </Behavior>
  <Link from="camera.raw_image" to="image_display.image"/>
  <Link from="camera.raw_image" to="obj_rec_recognizer.image"/>
  <Link from="obj_rec_recognizer.model_name" to="input_collector.input"/>
  <Link from="obj_rec_recognizer.distance" to="input_collector.input"/>
  <Link from="obj_rec_recognizer.distance" to="subtraction.input_positive"/>
  <Link from="constant.value" to="subtraction.input_negative"/>
  <Link from="subtraction.difference" to="drive_system.linear_velocity"/>
</BehaviorNetwork>
"""
"""What the guide has its reader build, as `hri network format` writes it."""
PLACES = {
    "Camera": (60, 60),
    "ImageDisplay": (320, 30),
    "ObjRecRecognizer": (260, 160),
    "InputCollector": (560, 60),
    "Constant": (60, 420),
    "Subtraction": (330, 440),
    "DriveSystem": (560, 250),
}


class Composer:
    """The hands of a person, which count what they do."""

    def __init__(self, page):
        self.page, self.actions = page, 0

    def new(self, name):
        self.page.evaluate("location.hash = '#networks'")
        self.wait_for_behaviors()
        self.do("new")
        self.page.fill("#network-name", name)
        self.key("Enter")

    def open(self, path):
        self.page.evaluate("(path) => location.hash = '#networks/' + path", str(path))
        expect(self.page.locator(".status .path")).to_contain_text(os.path.basename(path))
        self.wait_for_behaviors()

    def wait_for_behaviors(self):
        """A studio that has just begun imports all behaviors; until then nothing is checked."""
        palette = self.page.locator(".composer .palette .behavior")
        expect(palette.first).to_be_visible()

    def do(self, action):
        self.actions += 1
        self.page.click(f"[data-action={action}]")

    def key(self, key):
        self.actions += 1
        self.page.keyboard.press(key)

    def drag_behavior(self, name):
        self.actions += 1
        x, y = PLACES[name]
        behavior = self.page.locator(".palette .behavior", has_text=f"Hri.{name}").first
        canvas = self.page.locator(".react-flow__pane")
        behavior.drag_to(canvas, target_position={"x": x, "y": y})

    def set(self, parameter, value):
        self.actions += 1
        self.page.get_by_label(parameter, exact=True).fill(value)
        self.page.keyboard.press("Enter")

    def link(self, source, target):
        self.actions += 1
        self.drag(self.handle(source, "source"), self.handle(target, "target"))

    def drag(self, source, target):
        for place, act in ((source, "down"), (target, "up")):
            box = place.bounding_box()
            middle = (box["x"] + box["width"] / 2, box["y"] + box["height"] / 2)
            self.page.mouse.move(*middle, steps=6)
            getattr(self.page.mouse, act)()

    def handle(self, port, side):
        return self.page.locator(f".react-flow__handle.{side}[data-port='{port}']")

    def choose_word(self, word):
        """Double-click a word of the text, again where the text moved under the hand."""
        place = self.page.locator(".xml-source .cm-content").get_by_text(word)
        for _ in range(10):
            place.dblclick()
            if self.page.evaluate("getSelection().toString()") == word.strip('"'):
                return
        raise AssertionError(f"{word} is never chosen")

    def part(self, id):
        return self.page.locator(f".react-flow__node[data-id='{id}']")

    def save(self):
        self.do("save")
        expect(self.page.locator(".status .notice")).to_contain_text("saved")
