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
        LankaraniNikravesh = FormulaInfo {
            name: "lankarani_nikravesh",
            formula: "a = 3 (1 - e^2) / 4",
            coefficient: |e| 0.75 * (1.0 - e * e),
            spring_factor: 1.0,
            source: "[LankaraniNikravesh1990], [BarrosKhatami2013, eq. 10]",
            defect: "made for e near 1: a cannot exceed 3/4, so that no impact returns less than 0.663; returns \
                     0.725 for e = 0.5",
        },
        /// Eq. 11 of the seed paper as printed, which no derivation gives.
        YePrinted = FormulaInfo {
            name: "ye_printed",
            formula: "a = 3 (1 - e^2) / (8 e)",
            coefficient: |e| 0.375 * (1.0 - e * e) / e,
            spring_factor: 1.0,
            source: "[BarrosKhatami2013, eq. 11]",
            defect: "dissipates half of what is needed as e goes to 1, and the same as `lankarani_nikravesh` at \
                     e = 0.5; returns 0.725 for e = 0.5",
        },
        /// That of Ye, Li and Zhu.
        Ye = FormulaInfo {
            name: "ye",
            formula: "a = 8 (1 - e) / (5 e)",
            coefficient: |e| 1.6 * (1.0 - e) / e,
            spring_factor: 1.0,
            source: "[YeLiZhu2009], [Flores2011]",
            defect: "dissipates 7 % more than needed as e goes to 1; returns 0.470 for e = 0.5",
        },
        /// Eq. 14 of the seed paper with its K_l in spring and damper.
        BarrosKhatami = FormulaInfo {
            name: "barros_khatami",
            formula: "a = 8 (1 - e) / (5 e), spring 3 k / 2",
            coefficient: |e| 1.6 * (1.0 - e) / e,
            spring_factor: 1.5,
            source: "[BarrosKhatami2013, eq. 14]",
            defect: "`ye` under a stiffer spring, which changes the force and not what is returned; returns 0.470 for \
                     e = 0.5",
        },
        /// Eq. 14 of the seed paper with its K_l in the damper alone.
        BarrosKhatamiDamper = FormulaInfo {
            name: "barros_khatami_damper",
            formula: "a = 24 (1 - e) / (10 e)",
            coefficient: |e| 2.4 * (1.0 - e) / e,
            spring_factor: 1.0,
            source: "[BarrosKhatami2013, eq. 14]",
            defect: "dissipates 60 % more than needed as e goes to 1; returns 0.363 for e = 0.5",
        },
        /// The inverse of what an impact returns.
        Exact = FormulaInfo {
            name: "exact",
            formula: "a (1 + e) = ln[(1 + a) / (1 - a e)]",
            coefficient: exact,
            spring_factor: 1.0,
            source: "[Gonthier2004]",
            defect: "none: returns 0.500 for e = 0.5",
        },
        /// The first to put the damping on the spring force.
        HuntCrossley = FormulaInfo {
            name: "hunt_crossley",
            formula: "a = 3 (1 - e) / 2",
            coefficient: |e| 1.5 * (1.0 - e),
            spring_factor: 1.0,
            source: "[HuntCrossley1975]",
            defect: "made for e near 1: no impact returns less than 0.488; returns 0.663 for e = 0.5",
        },
        /// That of Herbert and McWhannell.
        HerbertMcWhannell = FormulaInfo {
            name: "herbert_mcwhannell",
            formula: "a = 6 (1 - e) / ((2 e - 1)^2 + 3)",
            coefficient: |e| 6.0 * (1.0 - e) / ((2.0 * e - 1.0) * (2.0 * e - 1.0) + 3.0),
            spring_factor: 1.0,
            source: "[HerbertMcWhannell1977]",
            defect: "no impact returns less than 0.488; returns 0.594 for e = 0.5",
        },
        /// That of Lee and Wang.
        LeeWang = FormulaInfo {
            name: "lee_wang",
            formula: "a = 3 (1 - e) / 4",
            coefficient: |e| 0.75 * (1.0 - e),
            spring_factor: 1.0,
            source: "[LeeWang1983]",
            defect: "dissipates half of what is needed as e goes to 1, and no impact returns less than 0.663; returns \
                     0.799 for e = 0.5",
        },
        /// The fit that goes with the exact relation.
        Gonthier = FormulaInfo {
            name: "gonthier",
            formula: "a = (1 - e^2) / e",
            coefficient: |e| (1.0 - e * e) / e,
            spring_factor: 1.0,
            source: "[Gonthier2004]",
            defect: "dissipates a third more than needed as e goes to 1; returns 0.488 for e = 0.5",
        },
        /// That of Zhiying and Qishao.
        ZhiyingQishao = FormulaInfo {
            name: "zhiying_qishao",
            formula: "a = 3 (1 - e^2) exp(2 (1 - e)) / 4",
            coefficient: |e| 0.75 * (1.0 - e * e) * libm::exp(2.0 * (1.0 - e)),
            spring_factor: 1.0,
            source: "[ZhiyingQishao2006]",
            defect: "no impact returns less than 0.179; returns 0.483 for e = 0.5",
        },
        /// That of Gharib and Hurmuzlu.
        GharibHurmuzlu = FormulaInfo {
            name: "gharib_hurmuzlu",
            formula: "a = 1 / e",
            coefficient: |e| 1.0 / e,
            spring_factor: 1.0,
            source: "[GharibHurmuzlu2012]",
            defect: "made for e near 0: dissipates even at e = 1; returns 0.411 for e = 0.5",
        },
        /// That of Hu and Guo.
        HuGuo = FormulaInfo {
            name: "hu_guo",
            formula: "a = 3 (1 - e) / (2 e)",
            coefficient: |e| 1.5 * (1.0 - e) / e,
            spring_factor: 1.0,
            source: "[HuGuo2015]",
            defect: "off by up to 0.034; returns 0.488 for e = 0.5",
        },
        /// That of Safaeifar and Farshidianfar.
        SafaeifarFarshidianfar = FormulaInfo {
            name: "safaeifar_farshidianfar",
            formula: "a = 5 (1 - e) / (4 e)",
            coefficient: |e| 1.25 * (1.0 - e) / e,
            spring_factor: 1.0,
            source: "[SafaeifarFarshidianfar2020]",
            defect: "dissipates a sixth less than needed as e goes to 1; returns 0.536 for e = 0.5",
        },
        /// The explicit formula nearest to the exact one.
        CarvalhoMartins = FormulaInfo {
            name: "carvalho_martins",
            formula: "a = 3 (1 - e) (11 - e) / (2 (1 + 9 e))",
            coefficient: |e| 1.5 * (1.0 - e) * (11.0 - e) / (1.0 + 9.0 * e),
            spring_factor: 1.0,
            source: "[CarvalhoMartins2019]",
            defect: "returns 0.500 for e = 0.5 and is within 2e-4 from there to 1, but returns 0.129 for e = 0.1",
        },
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
