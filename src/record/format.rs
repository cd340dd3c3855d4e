//! The formats of record files.

use std::fmt;

/// The formats of record files.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Format {
    /// `time_s,accel_m_s2`.
    Csv,
    /// PEER, in g.
    PeerAt2,
    /// K-NET and KiK-net, in counts with a scale factor.
    Knet,
    /// ESM and ITACA, in cm/s2.
    Esm,
    /// CSMIP, volume 2.
    Csmip,
    /// COSMOS, volume 2.
    Cosmos,
    /// CSMIP, USC and RENADIC, BHRC: volume 1, uncorrected.
    Volume1,
    /// USGS, SMC.
    Smc,
    /// GeoNet of New Zealand, V1A and V2A.
    Geonet,
    /// CSMNC of China.
    Csmnc,
    /// AFAD of Turkey, in three columns.
    Afad,
    /// CWA of Taiwan.
    Cwa,
    /// UNAM of Mexico.
    Unam,
    /// Columns of text.
    Columns,
}

impl Format {
    /// Whether its files are made for several channels, so that the only one of a file is named as well.
    pub(super) fn has_channels(self) -> bool {
        matches!(self, Format::Csmip | Format::Cosmos | Format::Volume1 | Format::Geonet)
    }
}

impl fmt::Display for Format {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Format::Csv => "CSV",
            Format::PeerAt2 => "PEER AT2",
            Format::Knet => "K-NET, KiK-net",
            Format::Esm => "ESM, ITACA",
            Format::Csmip => "CSMIP volume 2",
            Format::Cosmos => "COSMOS volume 2",
            Format::Volume1 => "volume 1",
            Format::Smc => "USGS SMC",
            Format::Geonet => "GeoNet V1A, V2A",
            Format::Csmnc => "CSMNC",
            Format::Afad => "AFAD",
            Format::Cwa => "CWA",
            Format::Unam => "UNAM",
            Format::Columns => "columns of text",
        })
    }
}
