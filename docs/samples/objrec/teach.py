"""Teaches two cards from their pictures, notes what they cost, and finds them in other pictures.

python docs/samples/objrec/teach.py [PICTURE...]     a picture of a room, where you name none
"""

import sys
from dataclasses import replace
from datetime import date
from pathlib import Path

from hri.hal.drivers.still_image import read_still
from hri.vision import ModelSet, ObjectLearner, ObjectRecognizer, load_models, save_models
from hri.vision.objects.cutout import whole
from hri.vision.objects.learning import scale_from_width

CARDS = Path(__file__).parents[2] / "tutorials" / "vision-01-objects"
PRICES = {"coffee": 1.5, "rocket": 2.0}
WIDTH = 0.15
"""Meters; with it the recognizer knows how far away a card is."""
SET = Path("cards.mdl")


def teach() -> ModelSet:
    """Make a set with both cards, from one picture of each; more pictures show more sides."""
    models = ModelSet("sift")
    for name, price in PRICES.items():
        learner = ObjectLearner(name, models)
        file = CARDS / f"{name}.jpg"
        image = read_still(file).image
        outline = whole(image)  # the card fills the picture
        shown = learner.show(image, outline, scale_from_width(outline, WIDTH), str(file))
        print(f"{file.name}: {shown.reason}")
        card = replace(learner.model(date.today().isoformat()), attributes={"price": price})
        models = models.with_object(card)
    return models


def main(pictures: list[Path]) -> None:
    """Write the set, read it again, and recognize."""
    save_models(SET, teach())
    recognizer = ObjectRecognizer(load_models(SET))
    for picture in pictures or [CARDS / "room.jpg"]:
        for one in recognizer.recognize(read_still(picture).image):
            where = f"at ({one.x:.0f}, {one.y:.0f}), {100 * one.distance:.0f} cm away"
            print(f"{picture.name}: {one.name} {where}, {one.attributes['price']:.2f} euros")


if __name__ == "__main__":
    main([Path(name) for name in sys.argv[1:]])
