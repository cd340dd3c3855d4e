//! As much of a long table as a screen can show: of every few rows the smallest and the largest value of a column.

/// A row of a table and the value there.
pub type Cell = (usize, f64);

/// A column of a table that is filled row by row.
pub struct Column {
    /// From how many rows the smallest and the largest are kept.
    bin: usize,
    rows: usize,
    kept: Vec<Cell>,
    /// Smallest and largest in the present bin.
    extremes: Option<(Cell, Cell)>,
    last: Option<Cell>,
}

impl Column {
    /// Keeps two of every `bin` rows; all of them where that is 1.
    pub fn new(bin: usize) -> Column {
        Column { bin: bin.max(1), rows: 0, kept: Vec::new(), extremes: None, last: None }
    }

    pub fn push(&mut self, value: f64) {
        let here = (self.rows, value);
        if self.rows.is_multiple_of(self.bin) {
            self.close_bin();
        }
        // A line begins with the run.
        if self.rows == 0 {
            self.keep(here);
        }
        let (smallest, largest) = self.extremes.unwrap_or((here, here));
        let lower = if value < smallest.1 { here } else { smallest };
        let upper = if value > largest.1 { here } else { largest };
        self.extremes = Some((lower, upper));
        self.last = Some(here);
        self.rows += 1;
    }

    /// What is kept, in the order of the rows.
    pub fn finish(mut self) -> Vec<Cell> {
        self.close_bin();
        // And ends with it.
        if let Some(last) = self.last {
            self.keep(last);
        }
        self.kept
    }

    fn close_bin(&mut self) {
        if let Some((smallest, largest)) = self.extremes.take() {
            let (first, second) = if smallest.0 < largest.0 { (smallest, largest) } else { (largest, smallest) };
            self.keep(first);
            self.keep(second);
        }
    }

    fn keep(&mut self, cell: Cell) {
        if self.kept.last().is_none_or(|last| last.0 < cell.0) {
            self.kept.push(cell);
        }
    }
}
