from .audio_file import AudioFilePlayer as AudioFilePlayer, AudioFileRecorder as AudioFileRecorder
from .audio_level import AudioLevel as AudioLevel
from .battery import Battery as Battery
from .bumper import Bumper as Bumper
from .button import Button as Button
from .camera import Camera as Camera
from .cliff_sensor import CliffSensor as CliffSensor
from .configuration import Configuration as Configuration, load_configuration as load_configuration
from .drive import DriveSystem as DriveSystem, Odometry as Odometry, Stop as Stop
from .emergency_stop import EmergencyStop as EmergencyStop
from .gripper import Gripper as Gripper
from .joystick import Joystick as Joystick
from .microphone import Microphone as Microphone
from .motor import Motor as Motor
from .range_sensor import RangeSensor as RangeSensor
from .recognizer import Hypothesis as Hypothesis, Recognizer as Recognizer, Segment as Segment
from .resource import Description as Description, Resource as Resource
from .resource_manager import ResourceManager as ResourceManager
from .screen import Screen as Screen
from .speaker import Speaker as Speaker
from .stream import Stream as Stream
from .synthesizer import Synthesizer as Synthesizer
