"""The general behaviors, for any network of any robot."""
