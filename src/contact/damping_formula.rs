//! Damping of the law F = k d^n (1 + a v/V): the formulas for a from the coefficient of restitution e.
//!
//! A free impact of this law returns e_out with a (1 + e_out) = ln[(1 + a) / (1 - a e_out)], whatever n, k, the masses
//! and V are \[Gonthier2004\]. Only `exact` inverts that relation; each other formula has its own error. As e goes to 1
//! the relation becomes a = 3 (1 - e) / 2.

use super::catalogue::catalogue;

/// What is known of one formula. The texts are for a person and stand in docs/laws.md as they are here.
#[derive(Clone, Copy, Debug)]
#[non_exhaustive]
pub struct FormulaInfo {
    /// Name in a scene.
    pub name: &'static str,
    /// The formula.
    pub formula: &'static str,
    /// The same as a function: a for 0 < e <= 1.
    pub coefficient: fn(e: f64) -> f64,
    /// Factor on the spring of the law.
    pub spring_factor: f64,
    /// Where it comes from: entries of REFERENCES.bib.
    pub source: &'static str,
    /// What is wrong with it.
    pub defect: &'static str,
}

/// One whose spring is that of the law; where it comes from and what is wrong with it follow.
const fn formula(name: &'static str, formula: &'static str, coefficient: fn(e: f64) -> f64) -> FormulaInfo {
    FormulaInfo { name, formula, coefficient, spring_factor: 1.0, source: "", defect: "" }
}

impl FormulaInfo {
    const fn with_spring(self, spring_factor: f64) -> FormulaInfo {
        FormulaInfo { spring_factor, ..self }
    }

    const fn from(self, source: &'static str) -> FormulaInfo {
        FormulaInfo { source, ..self }
    }

    const fn but(self, defect: &'static str) -> FormulaInfo {
        FormulaInfo { defect, ..self }
    }
}

impl DampingFormula {
    /// a for a coefficient of restitution 0 < e <= 1.
    pub fn coefficient(self, e: f64) -> f64 {
        (self.info().coefficient)(e)
    }
}

catalogue! {
    /// A formula for a(e), dimensionless.
    DampingFormula: FormulaInfo {
        /// Eq. 10 of the seed paper.
        LankaraniNikravesh = formula("lankarani_nikravesh", "a = 3 (1 - e^2) / 4", |e| 0.75 * (1.0 - e * e))
            .from("[LankaraniNikravesh1990], [BarrosKhatami2013, eq. 10]")
            .but("made for e near 1: a cannot exceed 3/4, so that no impact returns less than 0.663; returns 0.725 \
                  for e = 0.5"),
        /// Eq. 11 of the seed paper as printed, which no derivation gives.
        YePrinted = formula("ye_printed", "a = 3 (1 - e^2) / (8 e)", |e| 0.375 * (1.0 - e * e) / e)
            .from("[BarrosKhatami2013, eq. 11]")
            .but("dissipates half of what is needed as e goes to 1, and the same as `lankarani_nikravesh` at e = \
                  0.5; returns 0.725 for e = 0.5"),
        /// That of Ye, Li and Zhu.
        Ye = formula("ye", "a = 8 (1 - e) / (5 e)", |e| 1.6 * (1.0 - e) / e)
            .from("[YeLiZhu2009], [Flores2011]")
            .but("dissipates 7 % more than needed as e goes to 1; returns 0.470 for e = 0.5"),
        /// Eq. 14 of the seed paper with its K_l in spring and damper.
        BarrosKhatami = formula("barros_khatami", "a = 8 (1 - e) / (5 e), spring 3 k / 2", |e| 1.6 * (1.0 - e) / e)
            .with_spring(1.5)
            .from("[BarrosKhatami2013, eq. 14]")
            .but("`ye` under a stiffer spring, which changes the force and not what is returned; returns 0.470 for \
                  e = 0.5"),
        /// Eq. 14 of the seed paper with its K_l in the damper alone.
        BarrosKhatamiDamper = formula("barros_khatami_damper", "a = 24 (1 - e) / (10 e)", |e| 2.4 * (1.0 - e) / e)
            .from("[BarrosKhatami2013, eq. 14]")
            .but("dissipates 60 % more than needed as e goes to 1; returns 0.363 for e = 0.5"),
        /// The inverse of what an impact returns.
        Exact = formula("exact", "a (1 + e) = ln[(1 + a) / (1 - a e)]", exact)
            .from("[Gonthier2004]")
            .but("none: returns 0.500 for e = 0.5"),
        /// The first to put the damping on the spring force.
        HuntCrossley = formula("hunt_crossley", "a = 3 (1 - e) / 2", |e| 1.5 * (1.0 - e))
            .from("[HuntCrossley1975]")
            .but("made for e near 1: no impact returns less than 0.488; returns 0.663 for e = 0.5"),
        /// That of Herbert and McWhannell.
        HerbertMcWhannell = formula(
            "herbert_mcwhannell", "a = 6 (1 - e) / ((2 e - 1)^2 + 3)",
            |e| 6.0 * (1.0 - e) / ((2.0 * e - 1.0) * (2.0 * e - 1.0) + 3.0),
        )
            .from("[HerbertMcWhannell1977]")
            .but("no impact returns less than 0.488; returns 0.594 for e = 0.5"),
        /// That of Lee and Wang.
        LeeWang = formula("lee_wang", "a = 3 (1 - e) / 4", |e| 0.75 * (1.0 - e))
            .from("[LeeWang1983]")
            .but("dissipates half of what is needed as e goes to 1, and no impact returns less than 0.663; returns \
                  0.799 for e = 0.5"),
        /// The fit that goes with the exact relation.
        Gonthier = formula("gonthier", "a = (1 - e^2) / e", |e| (1.0 - e * e) / e)
            .from("[Gonthier2004]")
            .but("dissipates a third more than needed as e goes to 1; returns 0.488 for e = 0.5"),
        /// That of Zhiying and Qishao.
        ZhiyingQishao = formula(
            "zhiying_qishao", "a = 3 (1 - e^2) exp(2 (1 - e)) / 4",
            |e| 0.75 * (1.0 - e * e) * libm::exp(2.0 * (1.0 - e)),
        )
            .from("[ZhiyingQishao2006]")
            .but("no impact returns less than 0.179; returns 0.483 for e = 0.5"),
        /// That of Gharib and Hurmuzlu.
        GharibHurmuzlu = formula("gharib_hurmuzlu", "a = 1 / e", |e| 1.0 / e)
            .from("[GharibHurmuzlu2012]")
            .but("made for e near 0: dissipates even at e = 1; returns 0.411 for e = 0.5"),
        /// That of Hu and Guo.
        HuGuo = formula("hu_guo", "a = 3 (1 - e) / (2 e)", |e| 1.5 * (1.0 - e) / e)
            .from("[HuGuo2015]")
            .but("off by up to 0.034; returns 0.488 for e = 0.5"),
        /// That of Safaeifar and Farshidianfar.
        SafaeifarFarshidianfar = formula("safaeifar_farshidianfar", "a = 5 (1 - e) / (4 e)", |e| 1.25 * (1.0 - e) / e)
            .from("[SafaeifarFarshidianfar2020]")
            .but("dissipates a sixth less than needed as e goes to 1; returns 0.536 for e = 0.5"),
        /// The explicit formula nearest to the exact one.
        CarvalhoMartins = formula(
            "carvalho_martins", "a = 3 (1 - e) (11 - e) / (2 (1 + 9 e))",
            |e| 1.5 * (1.0 - e) * (11.0 - e) / (1.0 + 9.0 * e),
        )
            .from("[CarvalhoMartins2019]")
            .but("returns 0.500 for e = 0.5 and is within 2e-4 from there to 1, but returns 0.129 for e = 0.1"),
    }
}

/// a with a (1 + e) = ln[(1 + a) / (1 - a e)].
///
/// With b = a e the relation is g(b) = b + b / e - ln(1 + b / e) + ln(1 - b) = 0 on 0 < b < 1, where g rises from its
/// root at 0 and falls to minus infinity: bisection in b, which needs no start value and cannot leave the interval.
fn exact(e: f64) -> f64 {
    if e >= 1.0 {
        return 0.0;
    }
    let g = |b: f64| b + b / e - libm::log1p(b / e) + libm::log1p(-b);
    // Near 0, g = (1 / e^2 - 1) b^2 / 2 - (1 / e^3 + 1) b^3 / 3 + ..., so that the root is near 3 e (1 - e^2) / (2 (1 +
    // e^3)).
    let (mut low, mut high) = (0.25 * e * (1.0 - e), 1.0);
    while high - low > f64::EPSILON * high {
        let middle = 0.5 * (low + high);
        if middle <= low || middle >= high {
            break;
        }
        if g(middle) > 0.0 {
            low = middle;
        } else {
            high = middle;
        }
    }
    0.5 * (low + high) / e
}
