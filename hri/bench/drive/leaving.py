"""In what mode a Create 2 is left when the program that drove it has ended, however that happened.

Real processes, as in `hri.bench.stops`. In its safe mode the base stays awake and its battery
drains, even on the charger; in its passive mode it charges, and falls asleep.
"""

from __future__ import annotations

import signal
from collections.abc import Iterator, Mapping

from hri.bench.broken_links import LINKS, chain_of, end
from hri.bench.stops import SLOW, Bench, driving_program
from hri.bench.table import Row, at_least, share
from hri.simulation.bases.emulated_create2 import PASSIVE

KILLED, FROZEN = signal.SIGKILL, signal.SIGSTOP
End = Mapping[str, signal.Signals]
"""What is sent to which links. A program that survives starts what it has lost, drives on, and is
killed then."""
ENDS: Mapping[str, End] = {
    "program ended by Ctrl-C": {"program": signal.SIGINT},
    "program ended by SIGTERM": {"program": signal.SIGTERM},
    "supervisor ended by SIGTERM": {"supervisor": signal.SIGTERM},
    "program killed": {"program": KILLED},
    "supervisor killed": {"supervisor": KILLED},
    "watchdog killed": {"watchdog": KILLED},
    "program, supervisor killed": {"program": KILLED, "supervisor": KILLED},
    "program, watchdog killed": {"program": KILLED, "watchdog": KILLED},
    "supervisor, watchdog killed": {"supervisor": KILLED, "watchdog": KILLED},
    "program killed, supervisor frozen": {"program": KILLED, "supervisor": FROZEN},
    "program killed, watchdog frozen": {"program": KILLED, "watchdog": FROZEN},
}
TRIES, QUICK_TRIES = 5, 1
QUIET = 1.0
"""Seconds without a byte after which nobody speaks to the base any more."""


def is_left_alone(bench: Bench, path: str, sent: End) -> bool:
    """Whether the base stands and is passive in the end."""
    with driving_program(bench, path, SLOW) as program:
        links = dict(zip(LINKS, chain_of(program), strict=True))
        try:
            time = bench.clock.now()
            for link, number in sent.items():
                links[link].send_signal(number)
            stopped = time + bench.stop_after(time)
            if "program" not in sent:
                bench.wait("driving on", lambda: bench.line.goes(SLOW, stopped))
                links["program"].kill()
            bench.wait("the last word", lambda: _is_quiet(bench))
        finally:
            end(links.values())
    return bench.line.base.mode == PASSIVE and not bench.line.base.is_rolling


def _is_quiet(bench: Bench) -> bool:
    time, _ = bench.line.came[-1]
    return bench.clock.now() - time > QUIET


def rows(quick: bool) -> Iterator[Row]:
    """Each end, some times."""
    tries, bench = QUICK_TRIES if quick else TRIES, Bench()
    with bench.port() as port:
        left = {
            name: sum(is_left_alone(bench, port.path, sent) for _ in range(tries))
            for name, sent in ENDS.items()
        }
    what = "ends of program, supervisor and watchdog after which a Create 2 stands in passive mode"
    yield share(what, sum(left.values()), tries * len(left), at_least(1.0)) | {"ends": left}
