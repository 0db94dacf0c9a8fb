from .robot import Robot as Robot

__version__: str
