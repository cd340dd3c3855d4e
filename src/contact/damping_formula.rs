//! Damping of the law F = k d^n (1 + a v/V): the formulas for a from the coefficient of restitution e.
//!
//! A free impact of this law returns e_out with a (1 + e_out) = ln[(1 + a) / (1 - a e_out)], whatever n, k, the masses
//! and V are \[Gonthier2004\]. Only `exact` inverts that relation; each other formula has its own error, which its
//! description states at e = 0.5.

/// A formula for a(e).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum DampingFormula {
    /// a = 3 (1 - e^2) / 4 (seed paper, eq. 10)
    ///
    /// Derived for e near 1 \[LankaraniNikravesh1990\]: a never exceeds 3/4, so no impact returns less than 0.663.
    LankaraniNikravesh,
    /// a = 3 (1 - e^2) / (8 e) (seed paper, eq. 11 as printed)
    ///
    /// As printed: the same as lankarani_nikravesh at e = 0.5, and half of what is needed as e goes to 1.
    YePrinted,
    /// a = 8 (1 - e) / (5 e)
    ///
    /// Returns 0.470 for e = 0.5 \[YeLiZhu2009\].
    Ye,
    /// a = 8 (1 - e) / (5 e) with spring 3 k / 2 (seed paper, eq. 14)
    ///
    /// That of ye with the spring at 3 k / 2; returns 0.470 for e = 0.5.
    BarrosKhatami,
    /// a = 24 (1 - e) / (10 e) with spring k (seed paper, eq. 14 on the damper only)
    ///
    /// Returns 0.363 for e = 0.5.
    BarrosKhatamiDamper,
    /// a (1 + e) = ln[(1 + a) / (1 - a e)]
    ///
    /// Returns e.
    Exact,
    /// a = 3 (1 - e) / 2
    ///
    /// For e near 1 \[HuntCrossley1975\]; returns 0.663 for e = 0.5.
    HuntCrossley,
    /// a = 6 (1 - e) / ((2 e - 1)^2 + 3)
    ///
    /// Returns 0.594 for e = 0.5.
    HerbertMcWhannell,
    /// a = 3 (1 - e) / 4
    ///
    /// Half of what is needed as e goes to 1; returns 0.799 for e = 0.5.
    LeeWang,
    /// a = (1 - e^2) / e
    ///
    /// Explicit fit \[Gonthier2004\]; returns 0.488 for e = 0.5.
    Gonthier,
    /// a = 3 (1 - e^2) exp(2 (1 - e)) / 4
    ///
    /// Returns 0.483 for e = 0.5.
    ZhiyingQishao,
    /// a = 1 / e
    ///
    /// For e near 0: dissipates even at e = 1; returns 0.411 for e = 0.5.
    GharibHurmuzlu,
    /// a = 3 (1 - e) / (2 e)
    ///
    /// Returns 0.488 for e = 0.5.
    HuGuo,
    /// a = 5 (1 - e) / (4 e)
    ///
    /// Returns 0.536 for e = 0.5.
    SafaeifarFarshidianfar,
    /// a = 3 (1 - e) (11 - e) / (2 (1 + 9 e))
    ///
    /// Returns 0.5002 for e = 0.5, within 2e-4 from there to 1.
    CarvalhoMartins,
}

impl DampingFormula {
    /// All formulas, in the order in which the documentation shows them.
    pub const ALL: &'static [DampingFormula] = &[
        DampingFormula::LankaraniNikravesh,
        DampingFormula::YePrinted,
        DampingFormula::Ye,
        DampingFormula::BarrosKhatami,
        DampingFormula::BarrosKhatamiDamper,
        DampingFormula::Exact,
        DampingFormula::HuntCrossley,
        DampingFormula::HerbertMcWhannell,
        DampingFormula::LeeWang,
        DampingFormula::Gonthier,
        DampingFormula::ZhiyingQishao,
        DampingFormula::GharibHurmuzlu,
        DampingFormula::HuGuo,
        DampingFormula::SafaeifarFarshidianfar,
        DampingFormula::CarvalhoMartins,
    ];

    /// Name in a scene.
    pub const fn name(self) -> &'static str {
        match self {
            Self::LankaraniNikravesh => "lankarani_nikravesh",
            Self::YePrinted => "ye_printed",
            Self::Ye => "ye",
            Self::BarrosKhatami => "barros_khatami",
            Self::BarrosKhatamiDamper => "barros_khatami_damper",
            Self::Exact => "exact",
            Self::HuntCrossley => "hunt_crossley",
            Self::HerbertMcWhannell => "herbert_mcwhannell",
            Self::LeeWang => "lee_wang",
            Self::Gonthier => "gonthier",
            Self::ZhiyingQishao => "zhiying_qishao",
            Self::GharibHurmuzlu => "gharib_hurmuzlu",
            Self::HuGuo => "hu_guo",
            Self::SafaeifarFarshidianfar => "safaeifar_farshidianfar",
            Self::CarvalhoMartins => "carvalho_martins",
        }
    }

    /// The formula of that name in a scene.
    pub fn from_name(name: &str) -> Option<DampingFormula> {
        Self::ALL.iter().copied().find(|formula| formula.name() == name)
    }

    /// a for a coefficient of restitution 0 < e <= 1.
    pub fn coefficient(self, e: f64) -> f64 {
        match self {
            Self::LankaraniNikravesh => 0.75 * (1.0 - e * e),
            Self::YePrinted => 0.375 * (1.0 - e * e) / e,
            Self::Ye | Self::BarrosKhatami => 1.6 * (1.0 - e) / e,
            Self::BarrosKhatamiDamper => 2.4 * (1.0 - e) / e,
            Self::Exact => exact(e),
            Self::HuntCrossley => 1.5 * (1.0 - e),
            Self::HerbertMcWhannell => 6.0 * (1.0 - e) / ((2.0 * e - 1.0) * (2.0 * e - 1.0) + 3.0),
            Self::LeeWang => 0.75 * (1.0 - e),
            Self::Gonthier => (1.0 - e * e) / e,
            Self::ZhiyingQishao => 0.75 * (1.0 - e * e) * libm::exp(2.0 * (1.0 - e)),
            Self::GharibHurmuzlu => 1.0 / e,
            Self::HuGuo => 1.5 * (1.0 - e) / e,
            Self::SafaeifarFarshidianfar => 1.25 * (1.0 - e) / e,
            Self::CarvalhoMartins => 1.5 * (1.0 - e) * (11.0 - e) / (1.0 + 9.0 * e),
        }
    }

    /// Factor on the spring: 3/2 where the seed paper's eq. 14 is read with its K_l in the spring too.
    pub fn spring_factor(self) -> f64 {
        if self == Self::BarrosKhatami { 1.5 } else { 1.0 }
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
    // Near 0, g = (1 / e^2 - 1) b^2 / 2 - (1 / e^3 + 1) b^3 / 3 + ..., so that the root is near 3 e (1 - e^2) / (2 (1 + e^3)).
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
