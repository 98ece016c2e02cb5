#!/usr/bin/env python3
"""Writes all generated meshes and ADF files of ambf_models. Needs Python 3.11 and numpy.

generate.py [--out FOLDER]       FOLDER defaults to ambf_models itself
"""

import argparse
from pathlib import Path

import original_places
import scene_arm7
import scene_cloth
import scene_cloth_two_hands
import scene_cubes
import scene_door
import scene_dvrk
import scene_ecm
import scene_four_bar
import scene_four_hands
import scene_gallbladder
import scene_ghost
import scene_grasps
import scene_grippers
import scene_incision
import scene_instruments
import scene_knot_env
import scene_kuka
import scene_lab
import scene_magnet
import scene_mtm
import scene_needle
import scene_needle_drive
import scene_neuro
import scene_original
import scene_peg_transfer
import scene_peritoneum
import scene_pr2
import scene_practice
import scene_psm
import scene_puzzles
import scene_raven
import scene_ring_wire
import scene_rover
import scene_screwdriver
import scene_screwdriver_env
import scene_slope
import scene_sophie
import scene_stewart_platform
import scene_study_b
import scene_suj
import scene_suture_pad
import scene_suturing
import scene_swab
import scene_thread
import scene_thread_over_pegs
import scene_tissue
import scene_tissue_retract
import scene_toy_car
import scene_toy_car2
import scene_worlds
import textures
import touch_parts

SCENES = (
    textures,
    scene_lab,
    scene_arm7,
    scene_four_bar,
    scene_stewart_platform,
    scene_grippers,
    scene_peg_transfer,
    scene_ring_wire,
    scene_needle,
    scene_suturing,
    scene_cubes,
    scene_toy_car,
    touch_parts,
    scene_grasps,
    scene_magnet,
    scene_door,
    scene_ghost,
    scene_slope,
    scene_screwdriver,
    scene_thread,
    scene_rover,
    scene_cloth,
    scene_cloth_two_hands,
    scene_tissue,
    scene_tissue_retract,
    scene_incision,
    scene_thread_over_pegs,
    scene_suture_pad,
    scene_needle_drive,
    scene_peritoneum,
    scene_gallbladder,
    scene_swab,
    scene_psm,
    scene_ecm,
    scene_mtm,
    scene_suj,
    scene_kuka,
    scene_neuro,
    scene_raven,
    scene_pr2,
    scene_dvrk,
    scene_instruments,
    scene_puzzles,
    scene_study_b,
    scene_practice,
    scene_four_hands,
    scene_screwdriver_env,
    scene_knot_env,
    scene_original,
    scene_toy_car2,
    scene_sophie,
    original_places,
    scene_worlds,
)


def generate(models):
    """`models`: folder to write meshes/ and descriptions/ into."""
    for scene in SCENES:
        scene.build(Path(models))


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--out", type=Path, default=Path(__file__).resolve().parents[1])
    generate(parser.parse_args().out)
