"""As 3.0's control by windows: sliders of Tk set the set-points of an arm, a jaw and the endoscope at 200 Hz."""

import tkinter
from functools import partial

import numpy as np
from arms import ECM, PSM
from manager import SimulationManager

manager = SimulationManager("gui_control")
psm, ecm = PSM(manager, "psm2"), ECM(manager, "CameraFrame")
eye = ecm.get_T_c_w()
start = psm.measured_jp()
window = tkinter.Tk()
window.title("psm2")
wanted = [*start, 0.5, 0.0]  # six joints, the jaw, how far the endoscope is moved
sliders = []


def slid(i, text):
    wanted[i] = float(text)


for i, name in enumerate((*psm.get_joint_names()[:6], "jaw", "endoscope")):
    slider = tkinter.Scale(window, label=name, from_=-3.0, to=3.0, resolution=0.001, orient="horizontal", length=300)
    slider.set(wanted[i])
    slider.configure(command=partial(slid, i))
    slider.pack()
    sliders.append(slider)

goal = np.array([*(start + (0.1, -0.1, 0.01, 0.2, 0.15, -0.1)), 0.3, 0.005])
seen_eye = ecm.get_T_c_w()
seen_eye[:3, 3] += (0.0, 0.0, goal[7])


def arrived():
    there = np.abs(psm.measured_jp() - goal[:6]).max() < 0.02 and abs(psm.base.get_joint_pos(6) - goal[6]) < 0.02
    return there and np.abs(ecm.measured_cp() - seen_eye).max() < 1e-3


rate = manager.create_rate(200)
window.update()
print("open", flush=True)
for slider, value in zip(sliders, goal, strict=True):
    slider.set(value)
while not manager.is_shutdown() and not arrived():
    window.update()
    psm.servo_jp(wanted[:6])
    psm.set_jaw_angle(wanted[6])
    pose = eye.copy()
    pose[2, 3] += wanted[7]
    ecm.servo_cp(pose)
    rate.sleep()
window.destroy()
print("done", flush=True)
