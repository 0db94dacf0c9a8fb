"""Order five photos from test_event.py, and end it when they are there."""

from hri.net import Connection

SHOOT = "Examples.PhotoEvent.Shoot?count=5&amp;delay=1&amp;name=b_"
END = "Examples.PhotoEvent.End"


def message(event: str) -> str:
    """The line that raises an event over there."""
    return f'<event_server><event count="1">{event}</event></event_server>'


def main(host: str = "127.0.0.1", port: int = 25000) -> None:
    """Talk with the event server."""
    with Connection(host, port, timeout=30) as connection:
        connection.send(message(SHOOT))
        for line in connection:
            print("Received:", line)
            if "Done" in line:
                connection.send(message(END))
                break


if __name__ == "__main__":
    main()
