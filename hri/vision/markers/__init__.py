"""Printed markers: AprilTag, ArUco and QR codes, where they are, and how they are turned."""
