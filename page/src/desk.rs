//! What is asked, and who answers it.

use crate::job::Job;
use crate::message::{Answer, Refusal, parts};
use crate::motion::Said;
use crate::run::Wishes;
use crate::scene::Given;
use crate::{edit, files, laws, look, motion, run, scene, spectrum, study};
use serde::Deserialize;

/// Where questions come in, one after the other.
pub struct Desk {
    answer: Answer,
    job: Option<Box<dyn Job>>,
}

/// The first part of a question. The second part is the scene, and those that follow are the records of these names; a
/// question about a record alone has that record as its second part.
#[derive(Deserialize)]
struct Question {
    #[serde(flatten)]
    call: Call,
    #[serde(default)]
    records: Vec<String>,
}

#[derive(Deserialize)]
#[serde(tag = "call", rename_all = "camelCase")]
enum Call {
    /// What is wrong with the scene.
    Problems,
    /// What looks like a slip in it.
    Warnings,
    /// Both, with their lines.
    Findings,
    /// What can be drawn of it.
    Look,
    /// The laws of contact.
    Laws,
    /// The scene's text with values set by path.
    Edit { changes: Vec<(String, serde_json::Value)> },
    /// Begins a run.
    Run(Wishes),
    /// Begins a study of gaps, m.
    Study { gaps: Vec<f64> },
    /// What is in the record of this name, with what is said about it as a scene says it.
    Record {
        name: String,
        #[serde(default)]
        said: Said,
    },
    /// Begins the spectrum of such a record at these periods, s.
    Spectrum {
        name: String,
        #[serde(default)]
        said: Said,
        periods: Vec<f64>,
    },
    /// The FMU for a version of FMI; the libraries of these platforms are the parts behind the records.
    Fmu { fmi: serde_json::Value, libraries: Vec<String> },
    /// The table of the motion.
    Csv(Wishes),
    /// The table of the impacts.
    ImpactsCsv(Wishes),
    /// The report of a run.
    Report(Wishes),
    /// Goes on with what has begun.
    GoOn { pieces: usize },
}

impl Desk {
    /// Without an answer yet.
    pub const fn new() -> Desk {
        Desk { answer: Answer { bytes: Vec::new(), numbers: Vec::new() }, job: None }
    }

    /// Of the last question; of a refused one the refusal as JSON.
    pub fn answer(&self) -> &Answer {
        &self.answer
    }

    /// Takes a question, and says whether it has an answer.
    pub fn take(&mut self, question: &[u8]) -> bool {
        // What the last answer holds may be large.
        self.answer = Answer::default();
        let answered = self.ask(question);
        let is_well = answered.is_ok();
        let as_answer = |refusal: Refusal| Answer::json(&refusal, Vec::new());
        self.answer = answered.or_else(as_answer).unwrap_or_default();
        is_well
    }

    fn ask(&mut self, question: &[u8]) -> Result<Answer, Refusal> {
        let no_question = || Refusal::value("the bytes are no question");
        let parts = parts(question).ok_or_else(no_question)?;
        let (first, parts) = parts.split_first().ok_or_else(no_question)?;
        let Question { call, records } = serde_json::from_slice(first)
            .map_err(|error| Refusal::value(format!("a question that is not understood: {error}")))?;
        let given = Given::of(parts, &records);
        match call {
            Call::Problems => Answer::json(&scene::problems(&given), Vec::new()),
            Call::Warnings => Answer::json(&scene::warnings(&given), Vec::new()),
            Call::Findings => Answer::json(&scene::findings(&given), Vec::new()),
            Call::Look => look::look(&given),
            Call::Laws => laws::all(),
            Call::Edit { changes } => {
                edit::edited(parts.first().copied().unwrap_or_default(), &changes).map(|text| Answer::file(text.into()))
            }
            Call::Run(wishes) => self.begin(run::begin(&given, wishes)?),
            Call::Study { gaps } => self.begin(study::begin(&given, gaps)?),
            Call::Record { name, said } => motion::about(&name, &said, parts.first().copied().unwrap_or_default()),
            Call::Spectrum { name, said, periods } => {
                let content = parts.first().copied().unwrap_or_default();
                self.begin(spectrum::begin(motion::read(&name, &said, content)?.record, &name, periods)?)
            }
            Call::Fmu { fmi, libraries } => {
                let contents = parts.iter().skip(1 + records.len()).copied();
                files::fmu(&given, libraries.iter().map(String::as_str).zip(contents).collect(), &fmi)
            }
            Call::Csv(wishes) => files::motion_table(&given, &wishes),
            Call::ImpactsCsv(wishes) => files::impacts_table(&given, &wishes),
            Call::Report(wishes) => files::report_page(&given, &wishes),
            Call::GoOn { pieces } => match &mut self.job {
                Some(job) => job.go_on(pieces),
                None => Err(Refusal::value("nothing has begun that could go on")),
            },
        }
    }

    fn begin<J: Job + 'static>(&mut self, (job, answer): (J, Answer)) -> Result<Answer, Refusal> {
        self.job = Some(Box::new(job));
        Ok(answer)
    }
}

impl Default for Desk {
    fn default() -> Desk {
        Desk::new()
    }
}
