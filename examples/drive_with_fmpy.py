from fmpy import simulate_fmu

fmu, wanted = "target/fmu/FeupFrames.fmu", ["impacts", "contact[2].peak_force", "right.peak_drift[1]"]
for gap in [0.005, 0.02, 0.05, 0.11]:
    gaps = {"contact[1].gap": gap, "contact[2].gap": gap}
    result = simulate_fmu(fmu, stop_time=20.0, output_interval=0.01, start_values=gaps, output=wanted)
    impacts, force, drift = (result[name][-1] for name in wanted)
    print(f"gap {1e3 * gap:3.0f} mm: {impacts:3d} impacts, force up to {force:4.0f} N, drift up to {1e3 * drift:.1f} mm")
