//! Two storeys beside three, close together: the scenes of the C interface, the parameters, the description and the
//! scene files. They have no solution in closed form; what is asked of them is that every way to say the same gives the
//! same run.
//!
//! The texts are put together by the compiler, so that a test may edit one by its words.
#![allow(dead_code, unused_macros)] // each test uses its share

/// A contact table: floors, gap and law.
macro_rules! pair {
    ($left:literal, $right:literal, $gap:literal, $($law:literal),+) => {
        concat!(
            "\n[[contact]]\nleft_floor = ", $left, "\nright_floor = ", $right, "\ngap = ", $gap, "\n", $($law, "\n"),+
        )
    };
}

/// Both storeys of the left building, without its damping.
macro_rules! two_storeys {
    () => {
        "[left]\nmass = [3.65, 3.65]\nstiffness = [2910.0, 2910.0]\n"
    };
}

/// Driven by an input: everything that needs no record.
pub const SCENE: &str = concat!(
    "\nname = \"TwoBuildings\"\ndescription = \"2 and 3 storeys, driven from outside\"\nstop_time = 4.0\n\n",
    two_storeys!(),
    "damping = { ratio = 0.01 }\ninitial_velocity = [0.3, 0.5]\n\n",
    "[right]\nmass = [3.65, 3.65, 3.65]\nstiffness = [2910.0, 2910.0, 2910.0]\ndamping = { ratio = 0.02 }\n",
    "\n[inputs]\nfloor_forces = true\n",
    pair!(1, 1, "0.002", "law = \"kelvin_voigt\"", "stiffness = 1.0e6", "restitution = 0.65"),
    pair!(2, 2, "0.002", "law = \"hertz\"", "stiffness = 1.0e6"),
    "\n[outputs]\nenergy = true\n"
);

/// The same buildings under a record, with the other ways to give stiffness and damping.
pub const RECORD_SCENE: &str = concat!(
    "\nname = \"UnderARecord\"\nstop_time = 2.0\n\n",
    "[left]\nmass = [3.65, 3.65]\nstiffness_matrix = [[5820.0, -2910.0], [-2910.0, 2910.0]]\n",
    "damping = { rayleigh = { ratio = 0.02, modes = [1, 2] } }\n\n",
    "[right]\nmass = [3.65, 3.65, 3.65]\nstiffness = [2910.0, 2910.0, 2910.0]\n",
    "damping = { ratios = [0.01, 0.02, 0.03] }\n",
    "\n[ground]\nrecord = \"motion.csv\"\npga = 3.0\n",
    pair!(2, 2, "0.001", "law = \"kelvin_voigt_no_tension\"", "stiffness = 1.0e6", "restitution = 0.5")
);

/// Every kind of parameter and every law that has a number of its own kind; all pairs meet within a second.
pub const RICH: &str = concat!(
    "\nname = \"Rich\"\nstop_time = 1.0\n\n",
    "[left]\nmass = [3.65, 3.5]\nstiffness = [2910.0, 2800.0]\ndamping = { ratio = 0.01 }\n",
    "initial_displacement = [0.001, 0.002]\ninitial_velocity = [0.3, 0.5]\n\n",
    "[right]\nmass = [3.65, 3.6, 3.4]\nstiffness = [2910.0, 2700.0, 2600.0]\ndamping = { ratio = 0.02 }\n",
    "initial_displacement = [0.0005, 0.001, 0.002]\ninitial_velocity = [-0.1, -0.2, -0.3]\n",
    "\n[ground]\nrecord = \"motion.csv\"\nscale = 1.2\n",
    pair!(1, 1, "0.002", "law = \"kelvin_voigt\"", "stiffness = 1.0e6", "restitution = 0.65"),
    pair!(
        2,
        2,
        "0.003",
        "law = \"hertz_damped\"",
        "stiffness = 1.0e6",
        "exponent = 1.4",
        "restitution = 0.6",
        "damping_formula = \"exact\""
    ),
    pair!(1, 2, "0.0025", "law = \"jankowski\"", "stiffness = 2.0e6", "restitution = 0.7"),
    pair!(2, 1, "0.0035", "law = \"hertz\"", "stiffness = 1.5e6", "exponent = 1.6"),
    pair!(1, 3, "0.003", "law = \"stereomechanical\"", "restitution = 0.5"),
    pair!(2, 3, "0.004", "law = \"kelvin_voigt_no_tension\"", "stiffness = 5.0e5", "restitution = 0.55"),
    "\n[outputs]\nenergy = true\n\n[solver]\nrelative_tolerance = 1e-12\n"
);

/// Every optional table but `[ground]`, and no two numbers alike: what an edit changes is named by its words.
pub const WITHOUT_REPETITION: &str = concat!(
    "\nname = \"TwoFrames\"\ndescription = \"a test\"\nstop_time = 20.0\n\n",
    "[left]\nmass = [3.0, 4.0]\nstiffness = [2910.0, 2920.0]\ndamping = { ratio = 0.01 }\n\n",
    "[right]\nmass = [5.0, 6.0, 7.0]\nstiffness = [2930.0, 2940.0, 2950.0]\n",
    "damping = { rayleigh = { ratio = 0.05, modes = [1, 3] } }\n",
    "initial_displacement = [0.0, 0.001, 0.002]\ninitial_velocity = [0.0, 0.1, 0.2]\n",
    "\n[inputs]\nfloor_forces = true\n",
    pair!(1, 1, "0.002", "law = \"kelvin_voigt\"", "stiffness = 1.0e6", "restitution = 0.65"),
    pair!(2, 2, "-0.001", "law = \"hertz\"", "stiffness = 2.0e6"),
    "\n[outputs]\nenergy = true\n\n[solver]\nrelative_tolerance = 1e-10\nmin_approach_velocity = 1e-3\n"
);

/// Small, for random sequences of calls: the left building beside a single storey.
pub const CALLS: &str = concat!(
    "\nname = \"Calls\"\n",
    two_storeys!(),
    "damping = { ratio = 0.01 }\ninitial_velocity = [0.3, 0.5]\n",
    "[right]\nmass = [3.65]\nstiffness = [2910.0]\ndamping = { ratio = 0.02 }\n[inputs]\nfloor_forces = true",
    pair!(
        1,
        1,
        "0.002",
        "law = \"hertz_damped\"",
        "stiffness = 1.0e6",
        "restitution = 0.65",
        "damping_formula = \"ye\""
    )
);
