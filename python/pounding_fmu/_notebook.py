"""A run as a notebook shows it: what happened in few numbers, and a small picture."""

from __future__ import annotations

import base64
import html
import io
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from ._single import Result

MOST_ROOFS = 2  # that a small picture can show


def page(result: Result, name: str) -> str:
    """HTML of a run of the scene of that name; the picture is in it where matplotlib is installed."""
    time, impacts = result["time"], result.impacts
    rows = [("time", f"{time[0]:g} s to {time[-1]:g} s, {len(time)} rows of {len(result)} columns")]
    rows.append(("impacts", f"{len(impacts)}"))
    if len(impacts):
        hardest = impacts[impacts["peak_force"].argmax()]
        force, contact, start = hardest["peak_force"], hardest["contact"], hardest["start_s"]
        rows.append(("largest force", f"{force:.5g} N, contact {contact}, in the impact from {start:.3f} s"))
    cells = "".join(f"<tr><th>{title}</th><td>{text}</td></tr>" for title, text in rows)
    return f"<div><b>{html.escape(name)}</b><table>{cells}</table>{picture(result)}</div>"


def picture(result: Result) -> str:
    """The roofs and the sum of all contact forces over time; nothing where matplotlib or such columns are missing. Of more than
    two buildings, the two whose roofs move farthest."""
    try:
        from matplotlib.figure import Figure
    except ImportError:
        return ""
    from .plots.style import looks

    # In the order of the FMU the highest floor is the last one.
    every = {name.partition(".displacement[")[0]: name for name in result if ".displacement[" in name}
    colours = {side: look["color"] for side, look in looks(result._names).items()}
    farthest = sorted(every, key=lambda side: abs(result[every[side]]).max())[-MOST_ROOFS:]
    roofs = {side: name for side, name in every.items() if side in farthest}
    forces = [result[name] for name in result if name.startswith("contact[") and name.endswith("].force")]
    if not roofs and not forces:
        return ""
    figure = Figure(figsize=(6.4, 3.0), layout="constrained")
    panels = figure.subplots(bool(roofs) + bool(forces), 1, sharex=True, squeeze=False)[:, 0]
    for side, name in roofs.items():
        panels[0].plot(result["time"], 1e3 * result[name], color=colours[side], linewidth=0.8, label=f"{side} roof")
        panels[0].set_ylabel("mm")
        panels[0].legend(loc="upper right", ncols=2, frameon=False, fontsize="small")
    if forces:
        panels[-1].plot(result["time"], sum(forces) / 1e3, color="black", linewidth=0.8, label="contact forces, sum")
        panels[-1].set_ylabel("kN")
        panels[-1].legend(loc="upper right", frameon=False, fontsize="small")
    panels[-1].set_xlabel("time [s]")
    drawn = io.BytesIO()
    figure.savefig(drawn, format="png", dpi=80)
    data = base64.b64encode(drawn.getvalue()).decode()
    return f'<img alt="roofs and contact forces over time" src="data:image/png;base64,{data}">'
