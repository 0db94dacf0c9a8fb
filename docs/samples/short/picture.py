"""Draw the face offscreen: a numpy array of RGB bytes."""

from pathlib import Path

from hri.core.picture_writer import write_picture
from hri.face import render_face

picture = render_face("person", expression="happy", viseme="aa", yaw=15, size=(320, 240))
write_picture(Path("happy.png"), picture)
print(picture.shape, picture.dtype)
