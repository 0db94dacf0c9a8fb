"""What turns weights into pictures; the only place of the face that imports OpenCV and Pillow."""
