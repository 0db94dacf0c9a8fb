from .behavior import Behavior as Behavior, Context as Context
from .board import declare_slot as declare_slot
from .device import DeviceBehavior as DeviceBehavior
from .network import Link as Link, Network as Network
from .network_file import load_network as load_network
from .network_writer import save_network as save_network, write_network as write_network
from .ports import (
    Input as Input,
    Output as Output,
    Param as Param,
    declare_datatype as declare_datatype,
)
from .reason import Arrived as Arrived, Reason as Reason
from .runner import Runner as Runner
from .running import Networks as Networks
