import json

from hri.bench.net import LENGTH, _message, measure
from hri.net.malleable_protocol import encode


def test_the_bench_measures_messages_of_200_bytes_and_its_figures_are_json():
    assert len(encode(_message("there"))) == LENGTH == 200
    figures = json.loads(json.dumps(measure(messages=500, rounds=20)))
    for measured in (figures["bridge"], figures["peers"]["tcp lines, xml.etree"]):
        assert measured["messages_per_second"] > 0
        assert 0 < measured["round_trip_ms"]["median"] <= measured["round_trip_ms"]["p99"]
