from .connection import Connection as Connection, Disconnected as Disconnected
from .malleable import MalleableBehavior as MalleableBehavior
from .malleable_protocol import Item as Item, Message as Message, decode as decode, encode as encode
