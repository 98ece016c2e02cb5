"""Fuzzes the readers of foreign bytes for a while: any bytes end in a result or in a message (promise PR1).

The fuzzers need clang's libFuzzer and a build of their own (build-fuzz), of the few folders they use. The seeds are
copied, so that what the fuzzer finds on its way does not fill the source tree; an input that breaks something is kept.
"""

import os
import pathlib
import re
import shutil
import subprocess

import pytest

ROOT = pathlib.Path(__file__).resolve().parents[2]
BUILD = ROOT / "build-fuzz"
IN_CI = bool(os.environ.get("CI"))
LONGEST_INPUT = 20  # s for one input, on a machine that does other things too; libFuzzer's own default is 1200
MEMORY = 2048  # MB, most of it AddressSanitizer's


def run(command, **options):
    return subprocess.run(command, cwd=ROOT, text=True, errors="replace", capture_output=True, **options)


def libfuzzer_is_missing():
    """Why fuzzers cannot be built here, or nothing."""
    if shutil.which("clang++-14") is None:
        return "no clang++-14"
    resources = pathlib.Path(run(["clang++-14", "-print-resource-dir"]).stdout.strip())
    if not list(resources.glob("lib/linux/libclang_rt.fuzzer-*.a")):
        return "no libFuzzer for clang 14 (Debian: libclang-rt-14-dev)"
    return ""


@pytest.fixture(scope="module")
def fuzzers():
    if os.environ.get("AMBF_SANITIZER"):
        pytest.skip("the fuzzers bring their own AddressSanitizer; the release tests run them")
    missing = libfuzzer_is_missing()
    if missing:
        assert not IN_CI, missing
        pytest.skip(missing)
    if not (BUILD / "build.ninja").exists():
        configured = run(["cmake", "--preset", "fuzz"])
        assert configured.returncode == 0, configured.stdout + configured.stderr
    jobs = os.environ.get("AMBF_JOBS", str(os.cpu_count()))
    built = run(["cmake", "--build", BUILD, "--target", "ambf_fuzzers", "-j", jobs])
    assert built.returncode == 0, built.stdout[-10000:] + built.stderr[-10000:]
    return BUILD / "bin"


@pytest.mark.timeout(2400)
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
def test_any_bytes_end_in_a_result_or_a_message(fuzzers, tmp_path, reader, seconds):
    seeds = ROOT / "tests/fuzz/corpus" / reader
    corpus = tmp_path / "corpus"
    shutil.copytree(seeds, corpus)
    findings = BUILD / "findings"
    findings.mkdir(exist_ok=True)
    done = run(
        [
            fuzzers / f"fuzz_{reader}",
            f"-max_total_time={seconds}",
            f"-timeout={LONGEST_INPUT}",
            f"-rss_limit_mb={MEMORY}",
            f"-artifact_prefix={findings}/{reader}-",
            "-print_final_stats=1",
            corpus,
        ],
        timeout=seconds + 300,
    )
    log = done.stderr
    assert done.returncode == 0, f"the input is kept in {findings}\n{log[-10000:]}"
    # It did search: our code tells the fuzzer what it reached, and new inputs reached more than the seeds.
    executed = int(re.search(r"stat::number_of_executed_units:\s*(\d+)", log).group(1))
    reached = [int(n) for n in re.findall(r"\bcov: (\d+)", log)]
    assert executed > 3 * len(list(seeds.iterdir())), log[-3000:]
    assert reached[-1] > 500 and len(list(corpus.iterdir())) > len(list(seeds.iterdir())), log[-3000:]
    print(f"fuzz_{reader}: {executed} inputs in {seconds} s, {reached[-1]} branches")
