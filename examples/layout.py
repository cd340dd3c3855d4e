"""What stands where in a scene: floors at their levels, what meets at each contact. The engine's program says it."""

import json
import subprocess
import tempfile
from pathlib import Path

import numpy as np

from engine import program

SIDES = ("left", "right")


class Scene:
    """A scene file and what pictures need to know of it. Only buildings that are there are in its dictionaries."""

    def __init__(self, path):
        self.path = Path(path).resolve()
        told = ask(self.path)
        self.name = told["name"]
        self.floors = {side: told[side]["floors"] for side in SIDES if told[side]["floors"] > 0}
        levels = {side: told[side]["levels"] for side in self.floors}
        self.has_levels = None not in levels.values()
        # From the ground floor up: m, or storeys of height 1 where not all buildings have heights.
        self.levels = {
            side: np.array(levels[side]) if self.has_levels else np.arange(count + 1.0)
            for side, count in self.floors.items()
        }
        self.contacts = [Contact(contact, self) for contact in told["contacts"]]

    @property
    def top(self):
        return max(levels[-1] for levels in self.levels.values())

    @property
    def bottom(self):
        return min(levels[0] for levels in self.levels.values())


class Contact:
    """What meets on both sides of a gap. A surface is a dictionary: its `kind` is floor, columns or wall."""

    def __init__(self, told, scene):
        self.gap, self.law, self.row = told["gap"], told["law"], told["row"]
        self.surfaces = {side: told[side] for side in SIDES}
        heights = [height(surface, scene.levels) for surface in self.surfaces.values() if surface["kind"] != "wall"]
        self.height = float(np.mean(heights))
        self.meeting = in_words(*self.surfaces.values())
        self.name = self.meeting + (f", level {self.height:.4g} m" if scene.has_levels else "")

    def edges(self, run):
        """m, both surfaces over the time of a run: from where the left one is at rest, to the right."""
        left, right = np.zeros_like(run.time), np.full_like(run.time, self.gap)
        for side, floor, weight in self.row:
            if weight > 0:
                left += weight * run[f"{side}.displacement[{floor}]"]
            else:
                right -= weight * run[f"{side}.displacement[{floor}]"]
        return left, right

    def height_on(self, side, levels):
        """Where a building is touched, or None where it is not."""
        own = [surface for surface in self.surfaces.values() if surface.get("side") == side]
        return height(own[0], levels) if own else None


def height(surface, levels):
    """Of a floor or of a place on columns, among the levels of the buildings."""
    own = levels[surface["side"]]
    if surface["kind"] == "floor":
        return own[surface["floor"]]
    below, above = own[surface["storey"] - 1], own[surface["storey"]]
    return below + surface["position"] * (above - below)


def in_words(left, right):
    """What meets, in few words."""
    if left["kind"] == right["kind"] == "floor":
        is_same = left["floor"] == right["floor"]
        return f"floor {left['floor']} of both" if is_same else f"{called(left)}, {called(right)}"
    if "wall" in (left["kind"], right["kind"]):
        return f"{called(right)}, wall on its left" if left["kind"] == "wall" else f"{called(left)}, wall on its right"
    hits, hit = sorted((left, right), key=lambda surface: surface["kind"] == "columns")
    return f"{called(hits)}, columns of {called(hit)}"


def called(surface):
    what = "floor" if surface["kind"] == "floor" else "storey"
    return f"{surface['side']} {what} {surface[what]}"


def clamped(s):
    """How far columns with ends that do not rotate are displaced at the share s of their height: an S from 0 to 1."""
    return s * s * (3.0 - 2.0 * s)


def ask(path):
    """The scene as `simulate --layout` tells it. Where it is none, the program says what is wrong with it."""
    with tempfile.TemporaryDirectory() as folder:
        told = Path(folder, "layout.json")
        # Only the beginning of the run: nothing of the motion is asked for.
        command = [program(), path, "--layout", told, "--stop", "1e-6"]
        done = subprocess.run(command, capture_output=True, text=True)
        if done.returncode != 0:
            raise SystemExit(done.stderr.strip())
        return json.loads(told.read_text())
