"""What the bases speak: bytes out, bytes in. No port, no clock; one base is one file."""
