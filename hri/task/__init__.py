"""Tasks: cancellable coroutines on trio that wait for time and events."""
