"""The companion: what it does between its networks and its authored replies."""
