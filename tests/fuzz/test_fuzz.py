"""Fuzzes the readers of foreign bytes for a while: any bytes end in a result or in a message (promise PR1).

    ./dev test --only fuzz --sanitizer address

The fuzzers are part of the build for AddressSanitizer. The seeds are copied, so that what the fuzzer finds on its way
does not fill the source tree; an input that breaks something is kept.
"""

import os
import pathlib
import re
import shutil
import subprocess

import pytest

ROOT = pathlib.Path(__file__).resolve().parents[2]
IN_CI = bool(os.environ.get("CI"))
LONGEST_INPUT = 20  # s for one input, on a machine that does other things too; libFuzzer's own default is 1200
MEMORY = 2048  # MB, most of it AddressSanitizer's


@pytest.fixture(scope="module")
def build():
    if os.environ.get("AMBF_SANITIZER") != "address":
        pytest.skip("fuzzers are built for AddressSanitizer: ./dev test --only fuzz --sanitizer address")
    return pathlib.Path(os.environ["AMBF_BUILD_DIR"])


@pytest.mark.timeout(600)
@pytest.mark.parametrize(
    ("reader", "seconds"),
    [
        ("adf", 30 if IN_CI else 10),
        ("edit", 15 if IN_CI else 5),
        ("inputs", 5),
        ("mesh", 20 if IN_CI else 5),
        ("reader_answer", 10 if IN_CI else 5),
    ],
)
def test_any_bytes_end_in_a_result_or_a_message(build, tmp_path, reader, seconds):
    seeds = ROOT / "tests/fuzz/corpus" / reader
    corpus = tmp_path / "corpus"
    shutil.copytree(seeds, corpus)
    findings = build / "findings"
    findings.mkdir(exist_ok=True)
    done = subprocess.run(
        [
            build / f"bin/fuzz_{reader}",
            f"-max_total_time={seconds}",
            f"-timeout={LONGEST_INPUT}",
            f"-rss_limit_mb={MEMORY}",
            f"-artifact_prefix={findings}/{reader}-",
            "-print_final_stats=1",
            corpus,
        ],
        timeout=seconds + 300,
        text=True,
        errors="replace",
        capture_output=True,
    )
    log = done.stderr
    assert done.returncode == 0, f"the input is kept in {findings}\n{log[-10000:]}"
    # It did search: our code tells the fuzzer what it reached, and new inputs reached more than the seeds.
    executed = int(re.search(r"stat::number_of_executed_units:\s*(\d+)", log).group(1))
    reached = [int(n) for n in re.findall(r"\bcov: (\d+)", log)]
    assert executed > 3 * len(list(seeds.iterdir())), log[-3000:]
    least = 150 if reader == "inputs" else 500  # `inputs` is small
    assert reached[-1] > least and len(list(corpus.iterdir())) > len(list(seeds.iterdir())), log[-3000:]
    print(f"fuzz_{reader}: {executed} inputs in {seconds} s, {reached[-1]} branches")
