//! Frames on soil, with storeys that yield, P-delta, contacts with floors and columns, and foundations that are linked through
//! the soil, beside exponentials of the matrices of their phases (`physics/piecewise/`).

use super::shaking;
use crate::common::{Run, scene};
use crate::piecewise::{Piecewise, assert_same_motion};
use pounding::engine::{BuildingId, FoundationOutput as F, Output};
use pounding::scene::Scene;

const LEFT: &str = "mass = [4e4, 3e4]\nheight = [4.0, 3.0]\nstiffness = [3e7, 2e7]\n\
                    damping = { dashpots = [2e5, 1e5] }\n";
const RIGHT: &str = "mass = [5e4]\nheight = [3.0]\nstiffness = [6e7]\ndamping = { dashpots = [3e5] }\n";
const SWAY: &str = "sway = { stiffness = 9e7, dashpot = 1.5e6 }\n";
const ROCKING: &str = "inertia = 3e5\nrocking = { stiffness = 1.2e9, dashpot = 4e6 }\n";
const YIELDING: &str = "yield_force = [9e4, 6e4]\npost_yield_ratio = [0.05, 0.0]\n";
const GRAVITY: &str = "p_delta = true\n";

fn foundation(side: &str, motions: &str) -> String {
    format!("[{side}.foundation]\nmass = 3e4\n{motions}")
}

fn frames(left: &str, right: &str, more: &str) -> Scene {
    let text =
        format!("name = \"Frames\"\noutputs = {{ energy = true }}\n[left]\n{LEFT}{left}[right]\n{RIGHT}{right}{more}");
    let mut scene = scene(&text);
    scene.ground.record = Some("motion.csv".into());
    scene
}

fn same(scene: &Scene) -> (usize, usize) {
    let record = shaking();
    let times: Vec<f64> = (1..=60).map(|k| 0.1 * f64::from(k) + 0.003 * f64::from(k % 7)).collect();
    let Piecewise { yields, impacts, .. } = assert_same_motion(scene, &record, &times, 1e-12);
    (yields, impacts)
}

#[test]
fn sway_alone_rocking_alone_and_both_under_either_building() {
    for motions in [SWAY.to_owned(), ROCKING.to_owned(), SWAY.to_owned() + ROCKING] {
        same(&frames(&foundation("left", &motions), "", ""));
        same(&frames("", &foundation("right", &motions), ""));
    }
}

#[test]
fn storeys_yield_on_soil_with_and_without_gravity() {
    let soil = SWAY.to_owned() + ROCKING;
    for gravity in ["", GRAVITY] {
        let left = YIELDING.to_owned() + gravity + &foundation("left", &soil);
        let (yields, _) = same(&frames(&left, &foundation("right", ROCKING), ""));
        assert!(yields > 10, "{yields} yields");
    }
}

#[test]
fn foundations_are_linked_through_the_soil_while_floors_meet() {
    let (soil, link) = (SWAY.to_owned() + ROCKING, "left_floor = 0\nright_floor = 0\nstiffness = 3e7\ndashpot = 4e5\n");
    let contact = "left_floor = 1\nright_floor = 1\ngap = 0.004\n";
    const SPRING: &str = "stiffness = 4e8\n";
    for law in [
        format!("law = \"kelvin_voigt\"\nrestitution = 0.6\n{SPRING}"),
        format!("law = \"linear\"\n{SPRING}"),
        "law = \"stereomechanical\"\nrestitution = 0.6\n".to_owned(),
    ] {
        let left = YIELDING.to_owned() + GRAVITY + &foundation("left", &soil);
        let more = format!("[[link]]\n{link}[[contact]]\n{contact}{law}");
        let (yields, impacts) = same(&frames(&left, &foundation("right", &soil), &more));
        assert!(yields > 5 && impacts > 2, "{yields} yields, {impacts} impacts");
    }
}

#[test]
fn floors_hit_columns_of_storeys_that_lean_with_their_foundation() {
    let soil = SWAY.to_owned() + ROCKING;
    for storey in [1, 2] {
        let columns = format!("left_storey = {storey}\nleft_position = 0.4\nright_floor = 1\ngap = 0.003\n");
        let contact = format!("[[contact]]\n{columns}law = \"linear\"\nstiffness = 2e7\n");
        let right = foundation("right", ROCKING);
        let (_, impacts) = same(&frames(&foundation("left", &soil), &right, &contact));
        assert!(impacts > 2, "{impacts} impacts");
    }
}

/// By hand: u(s) = (1 - N) u_below + N u_above + (s - N) h phi, with N = 3 s^2 - 2 s^3, and 1/m = the sum of weight^2 / mass.
#[test]
fn columns_lean_with_the_foundation_where_they_are_hit() {
    let soil = SWAY.to_owned() + ROCKING;
    for (storey, height, below, above) in [(1, 4.0, 3e4, 4e4), (2, 3.0, 4e4, 3e4)] {
        let (s, gap): (f64, f64) = (0.4, 0.003);
        let columns = format!("left_storey = {storey}\nleft_position = {s:?}\nright_floor = 1\ngap = {gap:?}\n");
        let contact = format!("[[contact]]\n{columns}law = \"linear\"\nstiffness = 2e7\n");
        let scene = frames(&foundation("left", &soil), "", &contact);
        let n = s * s * (3.0 - 2.0 * s);
        let mass = 1.0 / ((1.0 - n).powi(2) / below + n * n / above + ((s - n) * height).powi(2) / 3e5 + 1.0 / 5e4);
        assert!((scene.contacts[0].reduced_mass(&scene) / mass - 1.0).abs() < 1e-14);
        let mut run = Run::new(&scene, Some(&shaking()));
        for k in 1..=200 {
            run.to(0.02 * f64::from(k));
            let of_soil = |of| run.read(Output::Foundation(BuildingId::LEFT, of));
            let lower =
                if storey == 1 { of_soil(F::Displacement) } else { run.displacement(BuildingId::LEFT, storey - 2) };
            let upper = run.displacement(BuildingId::LEFT, storey - 1);
            let columns = (1.0 - n) * lower + n * upper + (s - n) * height * of_soil(F::Rotation);
            let exact = columns - run.displacement(BuildingId::RIGHT, 0) - gap;
            assert!(
                (run.contact(0).penetration - exact).abs() < 1e-15,
                "{:e} not {exact:e}",
                run.contact(0).penetration
            );
        }
        assert!(!run.episodes.is_empty());
    }
}
