"""Sources that are compiled as one file in the sanitizers' trees do not see each other's own names."""

import pathlib
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "cmake"))

import group_sources  # noqa: E402


def groups(tmp_path, *texts):
    sources = []
    for number, text in enumerate(texts):
        (tmp_path / f"{number}.cpp").write_text(text)
        sources.append(group_sources.Source(tmp_path / f"{number}.cpp"))
    return group_sources.groups_of(sources, 3)


def own(text):
    return f"namespace {{\n{text}\n}}  // namespace\n"


def test_strangers_go_together_as_far_as_there_is_room(tmp_path):
    assert groups(tmp_path, *(own(f"constexpr int kPart{i} = 1;") for i in range(4))) == [0, 0, 0, 1]


def test_one_name_in_two_files_parts_them(tmp_path):
    assert groups(tmp_path, own("constexpr int kPart = 1;"), own("constexpr double kPart = 2.0;")) == [0, 1]
    assert groups(tmp_path, own("bool is(int a) {"), own("bool is(double a) {")) == [0, 1]
    assert groups(tmp_path, own("struct Part {"), "void f(base::Part part);") == [0, 1]


def test_what_both_take_from_one_namespace_may_meet(tmp_path):
    used = own("using math::Vec3;")
    assert groups(tmp_path, used, used, "math::Vec3 a();") == [0, 0, 0]
    assert groups(tmp_path, used, own("using drawn::Vec3;")) == [0, 1]
    assert groups(tmp_path, used, own("struct Vec3 {")) == [0, 1]
    assert groups(tmp_path, own("using Row = int;"), own("using Row = double;")) == [0, 1]


def test_members_and_locals_may_be_called_as_a_function_is(tmp_path):
    assert groups(tmp_path, own("int size(int a) {"), "int g(V v) {\n  return v.size();\n}") == [0, 0]


def test_words_in_comments_count_for_nothing(tmp_path):
    assert groups(tmp_path, own("struct Part {"), "// Part of it\nint i;") == [0, 0]


def test_files_that_change_the_preprocessor_stay_alone(tmp_path):
    assert groups(tmp_path, "#define A 1\n", "int i;") == [None, 0]
