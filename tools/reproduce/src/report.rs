//! The report: printed as tables, written as one self-contained page.

use std::fmt::Write;

/// A table: headings and rows of the same length.
pub struct Table {
    pub headings: Vec<String>,
    pub rows: Vec<Vec<String>>,
}

impl Table {
    pub fn new(headings: &[&str]) -> Self {
        Self { headings: headings.iter().map(|&h| h.to_owned()).collect(), rows: Vec::new() }
    }

    pub fn row(&mut self, cells: impl IntoIterator<Item = impl Into<String>>) {
        self.rows.push(cells.into_iter().map(Into::into).collect());
    }

    fn print(&self) {
        let mut table = presentation::table(&self.headings, self.headings.len());
        table.add_rows(&self.rows);
        println!("{table}\n");
    }

    fn html(&self) -> String {
        let line = |cells: &[String], tag: &str| {
            let cells: String = cells.iter().map(|cell| format!("<{tag}>{}</{tag}>", escape(cell))).collect();
            format!("<tr>{cells}</tr>")
        };
        let rows: String = self.rows.iter().map(|row| line(row, "td")).collect();
        format!("<table><thead>{}</thead><tbody>{rows}</tbody></table>", line(&self.headings, "th"))
    }
}

/// One figure or table of a paper, remade.
#[derive(Default)]
pub struct Exhibit {
    /// What it is: "Figure 2: ...".
    pub title: String,
    /// Figures as SVG.
    pub figures: Vec<String>,
    /// What the figures show.
    pub caption: String,
    /// What the paper states about it.
    pub paper: String,
    /// Quantity, the paper's value, ours, the ratio or difference.
    pub comparisons: Vec<[String; 4]>,
    /// More numbers of ours.
    pub tables: Vec<Table>,
    /// What the paper does not state and was assumed here.
    pub assumed: Vec<String>,
}

impl Exhibit {
    pub fn compare(&mut self, quantity: &str, paper: &str, ours: impl Into<String>, difference: impl Into<String>) {
        self.comparisons.push([quantity.to_owned(), paper.to_owned(), ours.into(), difference.into()]);
    }

    fn comparison(&self) -> Option<Table> {
        let mut table = Table::new(&["", "paper", "here", "ratio or difference"]);
        self.comparisons.iter().for_each(|row| table.row(row.clone()));
        (!table.rows.is_empty()).then_some(table)
    }

    /// Prints the numbers.
    pub fn print(&self) {
        println!("  {}", self.title);
        if let Some(table) = self.comparison() {
            table.print();
        }
        self.tables.iter().for_each(Table::print);
    }

    fn html(&self) -> String {
        let mut html = format!("<section><h3>{}</h3><div class=\"columns\"><div class=\"ours\">", escape(&self.title));
        for figure in &self.figures {
            let _ = write!(html, "<figure>{figure}</figure>");
        }
        if !self.caption.is_empty() {
            let _ = write!(html, "<p class=\"caption\">{}</p>", escape(&self.caption));
        }
        for table in &self.tables {
            html.push_str(&table.html());
        }
        let _ = write!(html, "</div><div class=\"paper\"><h4>The paper</h4><p>{}</p>", escape(&self.paper));
        if let Some(table) = self.comparison() {
            html.push_str(&table.html());
        }
        if !self.assumed.is_empty() {
            let items: String = self.assumed.iter().map(|text| format!("<li>{}</li>", escape(text))).collect();
            let _ = write!(html, "<h4>Assumed here</h4><ul>{items}</ul>");
        }
        html.push_str("</div></div></section>");
        html
    }
}

/// All exhibits of one paper.
pub struct Chapter {
    pub citation: &'static str,
    pub exhibits: Vec<Exhibit>,
}

/// The page. It refers to nothing outside itself.
pub fn page(chapters: &[Chapter], introduction: &str) -> String {
    let mut body = format!("<header><h1>Whither: the papers, remade</h1><p>{}</p></header>", escape(introduction));
    for chapter in chapters {
        let _ = write!(body, "<h2>{}</h2>", escape(chapter.citation));
        chapter.exhibits.iter().for_each(|exhibit| body.push_str(&exhibit.html()));
    }
    format!(
        "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><meta name=\"viewport\" content=\"width=device-width\">\
         <title>Whither: the papers, remade</title><style>{STYLE}</style></head><body>{body}</body></html>\n"
    )
}

/// Text as HTML.
pub fn escape(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}

const STYLE: &str = "
:root { color-scheme: light; }
body { max-width: 84rem; margin: 0 auto; padding: 2rem 1.5rem 5rem; background: #fff; color: #1d2129;
  font: 16px/1.55 system-ui, sans-serif; }
h1 { font-size: 2rem; margin: 0 0 .5rem; }
h2 { font-size: 1.3rem; line-height: 1.35; margin: 4rem 0 1rem; padding-top: 1rem; border-top: 3px solid #1d2129; }
h3 { font-size: 1.1rem; margin: 2.5rem 0 .75rem; }
h4 { font-size: .8rem; text-transform: uppercase; letter-spacing: .06em; color: #596173; margin: 1.25rem 0 .35rem; }
header p { max-width: 60rem; }
.columns { display: grid; grid-template-columns: minmax(0, 3fr) minmax(0, 2fr); gap: 2.5rem; align-items: start; }
.paper h4:first-child { margin-top: 0; }
.paper p, .paper ul { margin: 0; }
.paper ul { padding-left: 1.1rem; }
figure { margin: 0 0 .5rem; }
svg { display: block; width: 100%; height: auto; }
.caption { margin: .25rem 0 1rem; color: #596173; font-size: .9rem; }
table { border-collapse: collapse; font-size: .85rem; margin: .75rem 0; width: 100%; font-variant-numeric: tabular-nums; }
th, td { text-align: left; vertical-align: top; padding: .3rem .8rem .3rem 0; border-bottom: 1px solid #d9dde5; }
th { font-weight: 600; border-bottom-color: #596173; }
@media (max-width: 60rem) { .columns { grid-template-columns: minmax(0, 1fr); gap: 1rem; } }
";
