"""Over the network: the Malleable bridge, its client, the event server."""
