"""A program of our own in the place of client.xml: takes one message, and answers with one."""

from hri.net import Connection


def main(host: str = "127.0.0.1", port: int = 25000) -> None:
    """Talk with the network server.xml."""
    with Connection(host, port) as connection:
        print("Received:", connection.read())
        connection.send('<tutorial><text count="1">reply from client</text></tutorial>')


if __name__ == "__main__":
    main()
