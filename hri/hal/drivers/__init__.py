"""Drivers of real devices, files and memory; simulated ones live in `hri.simulation`."""

import os

# What OpenCV, FFmpeg and pygame print by themselves would hide our one clear line.
os.environ.setdefault("OPENCV_FFMPEG_LOGLEVEL", "-8")
os.environ.setdefault("OPENCV_LOG_LEVEL", "SILENT")
os.environ.setdefault("PYGAME_HIDE_SUPPORT_PROMPT", "1")
