"""Numbers on the command line of ambf-cli: what cannot be meant is told at once (exit code 2)."""

import pytest
from ambf_tools.cli.main import build_parser

ODD = ("nan", "inf", "-inf", "x", "")
TINY_RATES = ("1e-320", "1e-300", "1e-9", "-1")
HUGE = ("1e308", "1e10")

# Words of a command but for the number at {}, and the numbers that it takes; the others of these lists it refuses.
OPTIONS = [
    ("tf --rate {}", ("0.001", "50", "1000"), ("0", *TINY_RATES, *HUGE)),
    ("echo Box --rate {}", ("0", "0.001", "1000"), (*TINY_RATES, *HUGE)),
    ("publish /x --rate {}", ("0", "0.001", "1e3"), (*TINY_RATES, *HUGE)),
    ("latency --rate {}", ("1", "1e4"), ("0", "0.5", *TINY_RATES, *HUGE)),
    ("latency --objects 1,{}", ("200",), ("0", "-1", "201", "1.5", "1e2", "9" * 400)),
    ("latency --queues 1,{}", ("1", "10000"), ("0", "-1", "10001", "9" * 400)),
    ("latency --for {}", ("0", "1e-320"), ("-1e-320", *HUGE)),
    ("echo Box --count {}", ("0", "1000000000"), ("-1", "1.5", "1e3", "9" * 400, "9" * 5000)),
    ("step {}", ("0", "1000000000"), ("-1", "1e3", "1000000001", "9" * 400)),
    ("set Box --for {}", ("0", "1e-320", "1e9"), ("-1e-320", *HUGE)),
    ("publish /x --for {}", ("0", "1e9"), ("-1", *HUGE)),
    ("record --for {}", ("0", "1e9"), ("-1", *HUGE)),
    ("record --every {}", ("0", "1", "1000000"), ("-1", "1.5", "1000001", *HUGE)),
    ("record --min-free {}", ("0", "1e-320", "1e9"), ("-1", *HUGE)),
    ("set Box --pos 0 {} 0", ("-1e6", "1e6", "1e-320"), ("-1.1e6", "1.1e6", *HUGE)),
    ("set Box --rpy 0 {} 0", ("-1e9", "1e9"), HUGE),
    ("set Box --quat 0 {} 0 1", ("-1", "1e9"), HUGE),
    ("set Box --vel 0 {} 0", ("-1e6", "1e6"), ("-1.1e6", *HUGE)),
    ("set Box --angvel 0 {} 0", ("-1e6", "1e6"), ("-1.1e6", *HUGE)),
    ("set Box --force 0 {} 0", ("-1e9", "1e9"), ("-1.1e9", *HUGE)),
    ("set Box --torque 0 {} 0", ("-1e9", "1e9"), ("-1.1e9", *HUGE)),
    ("set Box --joint turn={}", ("-1e9", "1e-320"), ("-1.1e9", *HUGE)),
    ("set Box --joint-vel turn={}", ("-1e9",), ("-1.1e9", *HUGE)),
    ("set Box --joint-effort turn={}", ("-1e9",), ("-1.1e9", *HUGE)),
    ("devices set Left dominance {}", ("0", "-1e9"), HUGE),
    ("devices watch Left --for {}", ("0", "1e9"), ("-1", *HUGE)),
    ("dataset record x --episodes {}", ("0", "1000000000"), ("-1", "1.5", "1e3", "9" * 400)),
    ("dataset record x --seed {}", ("0", "1000000000"), ("-1", "1.5", "1e3", "9" * 400)),
    ("dataset record x --pictures 84 {}", ("8", "512"), ("0", "-1", "1.5", "1e3", "9" * 400)),
    ("dataset convert x.bag --fps {}", ("1", "1000"), ("0", "-1", "1.5", "1001", *HUGE)),
    ("load a.yaml --pos 0 {} 0", ("-1e6", "1e6"), ("-1.1e6", *HUGE)),
    ("load a.yaml --rpy 0 {} 0", ("-1e9",), HUGE),
]
PLACES = {"step": "n", "devices": "value"}  # numbers without an option


@pytest.mark.parametrize("words, good, bad", OPTIONS, ids=[words.replace("{}", "_") for words, _, _ in OPTIONS])
def test_numbers_out_of_range_are_refused(words, good, bad, capsys):
    parser = build_parser()
    for number in good:
        parser.parse_args(words.format(number).split(" "))
    for number in (*bad, *ODD):
        with pytest.raises(SystemExit) as ended:
            parser.parse_args(words.format(number).split(" "))
        told = capsys.readouterr().err.splitlines()[-1]
        assert ended.value.code == 2 and "error: argument " in told, number
        assert any(why in told for why in (" not between ", "neither 0 nor between", "must not be", "is no ")), told


def test_no_option_with_a_number_is_left_out():
    """One that takes numbers and is new belongs into the list above."""
    parser = build_parser()
    verbs = next(action for action in parser._actions if action.dest == "verb").choices
    numeric = {
        (verb, (action.option_strings or [action.dest])[-1])
        for verb, below in verbs.items()
        for action in below._actions
        if action.type is not None
    }
    named = {
        (verb, next((word for word in words.split() if word.startswith("--")), PLACES.get(verb)))
        for words, _, _ in OPTIONS
        for verb in words.split()[:1]
    }
    assert named == numeric
