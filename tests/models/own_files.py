"""Our own scenes as files: where they are, and how tests read them."""

import pathlib

import yaml

MODELS = pathlib.Path(__file__).resolve().parents[2] / "ambf_models"
DESCRIPTIONS = MODELS / "descriptions"
SCENES = sorted(DESCRIPTIONS.rglob("multi-bodies/**/*.yaml"))
MESHES = sorted((MODELS / "meshes").rglob("*.obj"))


def name_of(path):
    return path.stem


def load(path):
    return yaml.safe_load(path.read_text(encoding="utf-8"))


def scene(name):
    return load(next(path for path in SCENES if path.stem == name))


def bodies_of(model):
    return {name: model[name] for name in model["bodies"]}


def soft_bodies_of(model):
    return {name: model[name] for name in model.get("soft bodies", [])}


def joints_of(model):
    return {name: model[name] for name in model.get("joints", [])}
