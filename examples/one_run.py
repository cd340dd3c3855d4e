"""One run into numpy arrays: how often and how hard two frames meet, and what that does to the accelerations."""

import numpy as np
import pounding_fmu

FLOOR = "left.acceleration[2]"

scene = pounding_fmu.example_scene  # a path; the text of a scene or a dict will do, too
result = pounding_fmu.simulate(scene, step=0.001, parameters={"contact[1].gap": 0.01, "contact[2].gap": 0.01})
alone = pounding_fmu.simulate(scene, step=0.001, without_contacts=True)

impacts = result.impacts
hardest = impacts[impacts["peak_force"].argmax()]
duration = 1e3 * np.median(impacts["end_s"] - impacts["start_s"])
print(f"{len(impacts)} impacts, half of them shorter than {duration:.1f} ms")
print(f"the hardest: {hardest['peak_force']:.0f} N at {hardest['peak_time_s']:.3f} s, contact {hardest['contact']}")
print(f"{FLOOR} at most {abs(alone[FLOOR]).max():.1f} m/s2 without contact, {abs(result[FLOOR]).max():.0f} m/s2 with it")

# 68 impacts, half of them shorter than 4.2 ms
# the hardest: 1090 N at 3.612 s, contact 2
# left.acceleration[2] at most 12.4 m/s2 without contact, 280 m/s2 with it
