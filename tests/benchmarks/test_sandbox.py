"""What is sent, looked up or written elsewhere is found out; what stays here is not."""

import sys

import pytest

from benchmarks import sandbox
from benchmarks.sandbox import KILLED, STOPPED, created, require_sandbox, run, sent
from hri.core.errors import NotAvailable

SEND = "import socket; socket.socket(socket.AF_INET, socket.SOCK_DGRAM)"


@pytest.fixture(scope="module", autouse=True)
def is_permitted():
    try:
        require_sandbox()
    except NotAvailable as reason:
        pytest.skip(f"no sandbox: {reason}")


@pytest.mark.parametrize(
    ("program", "found"),
    [
        (f"{SEND}.connect(('192.0.2.1', 80))", "connect 192.0.2.1 port 80"),
        (f"{SEND}.sendto(b'x', ('192.0.2.1', 9))", "sendto 192.0.2.1 port 9"),
        (f"{SEND}.sendmsg([b'x'], [], 0, ('192.0.2.1', 9))", "sendmsg 192.0.2.1 port 9"),
        (f"{SEND}.sendto(b'x', ('127.0.0.1', 53))", "sendto 127.0.0.1 port 53"),
        (f"{SEND}.bind(('', 0))", "bind 0.0.0.0 port 0"),
        ("import socket; socket.getaddrinfo('example.org', 80)", "port 53"),
        (f"{SEND}.sendto(b'x', ('127.0.0.1', 9))", ""),
        ("import socket; socket.getaddrinfo('localhost', 80)", ""),
    ],
)  # fmt: skip
def test_what_is_sent_is_found_out(tmp_path, program, found):
    tried = run([sys.executable, "-c", program], tmp_path, 20)
    assert any(found in one for one in tried.sent) if found else not tried.sent


def test_a_child_process_is_found_out_too(tmp_path):
    child = "import socket; socket.socket(socket.AF_INET6).connect(('2001:db8::1', 9))"
    program = f"import subprocess, sys; subprocess.run([sys.executable, '-c', {child!r}])"
    assert run([sys.executable, "-c", program], tmp_path, 20).sent == (
        "connect 2001:db8::1 port 9",
    )


def test_what_is_written_outside_of_its_own_folders_is_found_out(tmp_path):
    script = """
    mkdir -p ~/.cache/hri ~/.cache/other; touch ~/.cache/hri/mine ~/.cache/other/theirs here.txt
    touch ~/gone; rm ~/gone
    touch $TMPDIR/forgotten
    """
    tried = run(["sh", "-c", script], tmp_path, 20)
    home = tmp_path / "home"
    assert tried.status == 0
    assert tried.written == (f"{home}/.cache/other/theirs", f"{home}/gone")
    assert tried.left == (f"{tmp_path}/temporary/forgotten",)


@pytest.mark.parametrize(
    ("script", "status"),
    [
        ("exec sleep 100", STOPPED),
        ("trap '' INT; sleep 100", KILLED),
        ("trap '' INT; sleep 100 & trap - INT; exec sleep 100", KILLED),
    ],
)
def test_a_command_that_goes_on_is_stopped_with_all_its_children(
    tmp_path, monkeypatch, script, status
):
    monkeypatch.setattr(sandbox, "PATIENCE", 0.2)
    assert run(["sh", "-c", script], tmp_path, 0.2).status == status


@pytest.mark.parametrize(
    ("line", "address"),
    [
        ('connect(3<UNIX:[9]>, {sa_family=AF_UNIX, sun_path="/run/nscd/socket"}, 110) = -1', ""),
        ("sendto(3<NETLINK:[9]>, [...], 20, 0, {sa_family=AF_NETLINK, nl_pid=0}, 12) = 20", ""),
        ("sendto(3<TCP:[127.0.0.1:1->127.0.0.1:2]>, \"x\", 1, 0, NULL, 0) = 1", ""),
        ("sendmmsg(3<UDP:[9]>, [{msg_hdr={msg_name={sa_family=AF_INET, sin_port=htons(53), "
         'sin_addr=inet_addr("10.0.0.1")}, msg_namelen=16', "sendmmsg 10.0.0.1 port 53"),
        ("connect(3<TCPv6:[9]>, {sa_family=AF_INET6, sin6_port=htons(443), "
         'sin6_flowinfo=htonl(0), inet_pton(AF_INET6, "2001:db8::1", &sin6_addr), '
         "sin6_scope_id=0}, 28) = -1", "connect 2001:db8::1 port 443"),
        ("bind(3<socket:[9]>, {sa_family=AF_BLUETOOTH, sa_data=...}, 8) = 0", "bind AF_BLUETOOTH"),
    ],
)  # fmt: skip
def test_the_address_of_a_system_call(line, address):
    assert sent(line) == address


def test_the_file_of_a_system_call():
    opened = 'openat(AT_FDCWD</>, "a", O_WRONLY|{}, 0666) = 3</home/ann/a>'
    assert created(opened.format("O_CREAT|O_CLOEXEC")) == "/home/ann/a"
    assert created(opened.format("O_CLOEXEC")) == ""
    assert created('creat("a", 0666) = 3</home/ann/a (deleted)>') == "/home/ann/a"
    assert created('openat(AT_FDCWD</>, "a", O_CREAT, 0666) = -1 ENOENT (No such file)') == ""
