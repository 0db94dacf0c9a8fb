"""The commands: `hri ...` and `behave`."""
