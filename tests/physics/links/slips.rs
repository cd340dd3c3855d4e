//! A hundred thousand slips of a friction damper, each a part of a closed form.

use super::devices::{Pair, between, linked, of_link, slipping};
use crate::bilinear::Oscillator;
use crate::common::assert_close;
use pounding::engine::{BuildingId, LinkOutput};

/// Forces that push the masses together and apart again and again, as in `physics/yielding_times.rs`.
#[test]
fn a_hundred_thousand_slips() {
    let Pair { mass, stiffness, .. } = Pair::USUAL;
    let spring = 4e6;
    for (ratio, share) in [(0.0, 1.2), (0.3, 3.0)] {
        let (whole, limit) = (stiffness + 2.0 * spring, 2e-3);
        let force = 2.0 * spring * limit;
        let pair = Pair { speeds: [0.0; 2], ..Pair::USUAL };
        let text = format!("{}[inputs]\nfloor_forces = true\n", pair.text());
        let scene = linked(&text, &[slipping(between(1, 1, spring, 0.0), force, ratio)]);
        let mut run = crate::common::Run::new(&scene, None);
        let w = f64::sqrt(whole / mass);
        let mut exact = Oscillator::new(w, limit, (stiffness + 2.0 * ratio * spring) / whole);
        let (mut slips, mut k) = (0, 0);
        while slips < 100_000 {
            let load = if k % 2 == 0 { share } else { -share } * whole * limit;
            exact = Oscillator { load: load / mass, ..exact };
            let time = 0.15 * f64::from(k + 1);
            slips += exact.switches(time).iter().filter(|now| now.sense != 0.0).count();
            exact = exact.at(time);
            run.state.set_floor_force(BuildingId::LEFT, 0, load);
            run.state.set_floor_force(BuildingId::RIGHT, 0, -load);
            run.to(time);
            k += 1;
            let residual = run.energy().residual;
            assert!(residual.abs() < 1e-12, "r = {ratio}, {slips} slips: {residual:e}");
        }
        let what = format!("r = {ratio}, {slips} slips");
        let travel = of_link(&run, 0, LinkOutput::SlipTravel);
        assert!(travel > 1e4 * limit, "{what}: {travel} m");
        assert_close(travel, 2.0 * exact.cumulative, 1e-11, &what);
        let lost = (1.0 - ratio) * force * travel;
        assert_close(of_link(&run, 0, LinkOutput::DissipatedEnergy), lost, 1e-14, &what);
        assert_close(run.energy().hysteretic, lost, 1e-14, &what);
        // What is left of many small differences.
        let slip = of_link(&run, 0, LinkOutput::Slip);
        let error = (slip - 2.0 * exact.plastic).abs() / (exact.limit + exact.furthest);
        assert!(error < 1e-10, "{what}: slip {slip:e} not {:e}", 2.0 * exact.plastic);
    }
}
