//! Bounds on the floors of a building within a step in contact: from both ends of the step, to which the peaks rise at once, and
//! bounds on the motion in between.

use crate::engine::base::Coordinates;
use crate::engine::base::peaks::Peaks;
use crate::engine::bounds::chord::{above, bound_by_deviation, bound_by_motion, bound_by_push, lower, set_largest};
use crate::engine::peaks::PeakFinder;
use crate::engine::peaks::reading::ContactStep;
use crate::engine::peaks::room::{FloorRoom, PeakWork};
use crate::engine::quantities::rows::PeakOf;
use crate::engine::step::Dense;
use crate::engine::taylor::solution::Solution;
use crate::numerics::polynomial::larger;
use crate::scene::Place;
use crate::structure::{BuildingId, MotionSeries};

impl PeakFinder<'_> {
    /// Raises the peaks of a building to the values at both ends of a step of `h` seconds, and bounds its floors in between;
    /// returns how many peaks may be exceeded.
    pub(super) fn bound_building(
        &self,
        id: BuildingId,
        (h, has_series): (f64, bool),
        peaks: &mut Peaks,
        room: &mut FloorRoom,
    ) -> u64 {
        let lanes = self.system.structure.floors.lanes_of(id);
        let of_peaks = [PeakOf::Displacement(id, 0), PeakOf::Drift(id, 0), PeakOf::Acceleration(id, 0)].map(|of| {
            let first = self.watched.rows.place(of);
            first..first + lanes.len()
        });
        let [of_displacements, of_drifts, of_accelerations] = of_peaks;
        let FloorRoom {
            start, end, pushes: [first, last], least, most, largest, largest_of_drifts, strays, upper, ..
        } = room;
        let [moved, drifted, pushed] = upper.each_mut().map(|upper| &mut upper[lanes.clone()]);
        let motion = [&start.u, &end.u, &start.v, &end.v, largest].map(|of| &of[lanes.clone()]);
        let moved_above = bound_by_motion(motion, h, &mut peaks.values[of_displacements], moved);
        let motion =
            [&start.drift, &end.drift, &start.drifting, &end.drifting, largest_of_drifts].map(|of| &of[lanes.clone()]);
        let drifted_above = bound_by_motion(motion, h, &mut peaks.values[of_drifts], drifted);
        let ends = [&start.resisted, &end.resisted, first, last].map(|of| &of[lanes.clone()]);
        let [least, most, strays] = [least, most, strays].map(|of| &of[lanes.clone()]);
        let pushed_above = match has_series {
            true => bound_by_deviation(ends, strays, &mut peaks.values[of_accelerations], pushed),
            false => bound_by_push(ends, [least, most, strays], &mut peaks.values[of_accelerations], pushed),
        };
        let shear = peaks.values[self.watched.rows.place(PeakOf::BaseShear(id))];
        let storeys = self.bound_storey_shears(id, h, room);
        let storeys_above = storeys.map(|((of, upper), _)| above(upper, peaks.values[self.watched.rows.place(of)]));
        let of_shears = storeys_above.sum::<u64>() + above(self.bound_shear(id, h, room).1, shear);
        moved_above + drifted_above + pushed_above + of_shears
    }

    /// For each storey of a building that can be corrected a bound on the magnitude of its shear over a step, and the
    /// shears at both ends, N: corrections are linear in time.
    pub(super) fn bound_storey_shears(
        &self,
        id: BuildingId,
        h: f64,
        room: &FloorRoom,
    ) -> impl Iterator<Item = ((PeakOf, f64), [f64; 2])> {
        let of_side = self.system.corrections.iter().filter(move |of| of.building == id);
        of_side.filter_map(move |of| {
            let FloorRoom { start, end, largest_of_drifts, .. } = room;
            let lane = self.system.structure.floors.lane(id, of.number);
            let ends = [start.storey_shear[lane], end.storey_shear[lane]];
            let stray = of.stiffness? * 0.125 * h * h * largest_of_drifts[lane];
            Some(((PeakOf::StoreyShear(id, of.number), larger(ends[0].abs(), ends[1].abs()) + stray), ends))
        })
    }

    /// The base shears at both ends of a step, and a bound on their magnitudes in between, N.
    #[inline(always)]
    pub(super) fn bound_shear(
        &self,
        id: BuildingId,
        length: f64,
        FloorRoom { start, end, largest, .. }: &FloorRoom,
    ) -> ([f64; 2], f64) {
        let shears = [start, end].map(|at| at.shear[id.index()]);
        (shears, larger(shears[0].abs(), shears[1].abs()) + self.shear_strays(id, length, largest))
    }

    /// Works out upper bounds on the accelerations of a body's floors.
    pub(super) fn bound_body(&self, b: usize, part: &ContactStep, room: &mut FloorRoom) {
        let lanes = self.system.structure.bodies[b].lanes.clone();
        let FloorRoom { start, end, least, most, largest, .. } = room;
        let ends = [&start.resisted, &end.resisted].map(|of| &of[lanes.clone()]);
        let forces = [least, most].map(|of| &of[lanes.clone()]);
        set_largest(ends, forces, part.strongest_ground(), &mut largest[lanes.clone()]);
        self.find_strays(b, part.length, room);
        for building in &self.system.structure.bodies[b].buildings {
            self.system.structure.floors.bound_drifts(building.building, &room.largest, &mut room.largest_of_drifts);
        }
    }

    /// Bounds by the series of a step: a floor's absolute acceleration a deviates from the chord of its values at both ends
    /// by at most h^2/8 max|u''''| in time, and by x^2/8 max|d^2a/dx^2| in the x of a time map. Writes these deviations,
    /// m/s2; returns whether the step has such a series.
    ///
    /// However long the step, and however quick the building's highest modes: the bounds of `floors.rs` need a short step.
    pub(super) fn bound_by_series(&self, part: &ContactStep, work: &mut PeakWork) -> bool {
        let Dense::Taylor(solution) = part.step.dense() else { return false };
        let FloorRoom { strays, modal, .. } = &mut work.peaks.floors;
        let is_on_modes = part.base.coordinates == Coordinates::Modes;
        let bounds = if is_on_modes { &mut *modal } else { &mut *strays };
        let of_ground = match solution.series.time_map.is_curved() {
            false => {
                solution.series.bound_fourths(&solution.end, bounds);
                let sag = 0.125 * part.length * part.length;
                bounds.iter_mut().for_each(|stray| *stray *= sag);
                0.0
            }
            true => bound_in_time_map(solution, part, &mut work.buffers.series, bounds),
        };
        if is_on_modes {
            self.system.structure.bound_floors(modal, strays);
        }
        strays.iter_mut().for_each(|stray| *stray += of_ground);
        true
    }

    /// Lowers upper bounds on the accelerations of the floors relative to the ground and to each other, by those at both ends and
    /// the deviations in between.
    pub(super) fn bound_building_by_series(&self, id: BuildingId, part: &ContactStep, room: &mut FloorRoom) {
        let floors = &self.system.structure.floors;
        let lanes = floors.lanes_with_foundation(id);
        let FloorRoom {
            start,
            end,
            pushes,
            strays,
            accelerations,
            drift_accelerations,
            largest,
            largest_of_drifts,
            drift_strays,
            ..
        } = room;
        let ground = part.base.ground();
        let ends = [(start, ground.acceleration), (end, ground.after(part.length))];
        for (k, (at, ground)) in ends.into_iter().enumerate() {
            for lane in lanes.clone() {
                accelerations[k][lane] = at.resisted[lane] + pushes[k][lane] - ground;
            }
            // The ground does not turn.
            if let Some(rotation) = floors.lane_of(id, Place::Rotation) {
                accelerations[k][rotation] += ground;
            }
            floors.set_drifts(id, &accelerations[k], &mut drift_accelerations[k]);
        }
        floors.bound_drifts(id, strays, drift_strays);
        let of_floors = floors.lanes_of(id);
        lower(
            accelerations.each_ref().map(|of| &of[lanes.clone()]),
            &strays[lanes.clone()],
            &mut largest[lanes.clone()],
        );
        lower(
            drift_accelerations.each_ref().map(|of| &of[of_floors.clone()]),
            &drift_strays[of_floors.clone()],
            &mut largest_of_drifts[of_floors.clone()],
        );
    }
}

/// The deviations from the chord in the x of the step's time map, without that of the ground's acceleration, which it
/// returns; `accelerations` is scratch.
fn bound_in_time_map(
    Solution { series, substitution, .. }: &Solution,
    part: &ContactStep,
    accelerations: &mut MotionSeries,
    strays: &mut [f64],
) -> f64 {
    let x = series.x_at(part.length);
    accelerations.set_accelerations(series, substitution);
    accelerations.bound_seconds(x, strays);
    // The ground's acceleration is linear in time, which is quadratic in x.
    let of_ground = 2.0 * (series.time_map.curvature * series.scale * part.base.ground().slope).abs();
    let sag = 0.125 * x * x;
    strays.iter_mut().for_each(|stray| *stray *= sag);
    sag * of_ground
}
