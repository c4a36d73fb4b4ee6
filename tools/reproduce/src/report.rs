//! The report: printed as tables, written as one self-contained page.

use presentation::{Panel, chart};
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
            let cells: String = cells.iter().map(|cell| format!("<{tag}>{}</{tag}>", typeset(cell))).collect();
            format!("<tr>{cells}</tr>")
        };
        let rows: String = self.rows.iter().map(|row| line(row, "td")).collect();
        // scrolls by itself where it is wider than the page
        let head = line(&self.headings, "th");
        format!("<div class=\"scroll\" tabindex=\"0\"><table><thead>{head}</thead><tbody>{rows}</tbody></table></div>")
    }
}

/// A figure: panels, so many in a row, each of this width and height.
pub struct Figure {
    pub panels: Vec<Panel>,
    columns: usize,
    size: (u32, u32),
}

impl Figure {
    pub fn new(panels: impl Into<Vec<Panel>>, columns: usize, size: (u32, u32)) -> Self {
        Self { panels: panels.into(), columns, size }
    }
}

/// One figure or table of a paper, remade.
#[derive(Default)]
pub struct Exhibit {
    /// What it is: "Figure 2: ...".
    pub title: String,
    pub figures: Vec<Figure>,
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

    /// `id` is what a link names it by.
    fn html(&self, id: &str) -> String {
        let title = typeset(&self.title);
        let mut html = format!("<section id=\"{id}\"><h3>{title}</h3><div class=\"columns\"><div class=\"ours\">");
        for Figure { panels, columns, size } in &self.figures {
            let _ = write!(html, "<figure>{}</figure>", chart(panels, *columns, *size));
        }
        if !self.caption.is_empty() {
            let _ = write!(html, "<p class=\"caption\">{}</p>", typeset(&self.caption));
        }
        for table in &self.tables {
            html.push_str(&table.html());
        }
        let _ = write!(html, "</div><div class=\"paper\"><h4>The paper</h4><p>{}</p>", typeset(&self.paper));
        if let Some(table) = self.comparison() {
            html.push_str(&table.html());
        }
        if !self.assumed.is_empty() {
            let items: String = self.assumed.iter().map(|text| format!("<li>{}</li>", typeset(text))).collect();
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

/// The page: contents, every comparison with a paper in one table, then the exhibits. It refers to nothing outside itself.
pub fn page(chapters: &[Chapter], introduction: &str) -> String {
    let mut contents = String::new();
    let mut body = String::new();
    let mut rows = String::new();
    for (number, Chapter { citation, exhibits }) in (1..).zip(chapters) {
        let citation = typeset(citation);
        let _ = write!(contents, "<li><a href=\"#paper-{number}\">{citation}</a><ul>");
        let _ = write!(body, "<h2 id=\"paper-{number}\">{citation}</h2>");
        for (place, exhibit) in (1..).zip(exhibits) {
            let id = format!("exhibit-{number}-{place}");
            let title = typeset(&exhibit.title);
            let _ = write!(contents, "<li><a href=\"#{id}\">{title}</a></li>");
            for [quantity, paper, ours, difference] in &exhibit.comparisons {
                let cells =
                    [quantity, paper, ours, difference].map(|cell| format!("<td>{}</td>", typeset(cell))).concat();
                let _ = write!(rows, "<tr><td><a href=\"#{id}\">{number}.{place}</a></td>{cells}</tr>");
            }
            body.push_str(&exhibit.html(&id));
        }
        contents.push_str("</ul></li>");
    }
    let introduction = typeset(introduction);
    format!(
        "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><meta name=\"viewport\" content=\"width=device-width\">\
         <meta name=\"color-scheme\" content=\"light dark\"><title>Whither: the papers, remade</title><style>{STYLE}</style></head><body>\
         <header><h1>Whither: the papers, remade</h1><p>{introduction}</p></header>\
         <nav aria-label=\"Contents\"><h2>Contents</h2><ol>{contents}</ol></nav>\
         <section id=\"summary\"><h2>In one table</h2><div class=\"scroll\" tabindex=\"0\"><table><thead><tr><th></th><th></th><th>paper</th><th>here</th>\
         <th>ratio or difference</th></tr></thead><tbody>{rows}</tbody></table></div></section>{body}</body></html>\n"
    )
}

/// Text as HTML, powers raised: `m/s^1.5`.
fn typeset(text: &str) -> String {
    let escaped = escape(text);
    let mut parts = escaped.split('^');
    let mut html = parts.next().unwrap_or_default().to_owned();
    for part in parts {
        let bare = part.trim_start_matches('-');
        let digits = bare.trim_start_matches(|c: char| c.is_ascii_digit());
        let fraction = digits.strip_prefix('.').map(|rest| rest.trim_start_matches(|c: char| c.is_ascii_digit()));
        // a full stop after a power ends a sentence
        let rest = fraction.filter(|rest| rest.len() + 1 < digits.len()).unwrap_or(digits);
        let (power, rest) = part.split_at(part.len() - rest.len());
        let _ = if power.is_empty() { write!(html, "^{rest}") } else { write!(html, "<sup>{power}</sup>{rest}") };
    }
    html
}

/// Text as HTML.
pub fn escape(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}

const STYLE: &str = "
:root { color-scheme: light dark; --ink: #1d2129; --muted: #596173; --line: #d9dde5; --ground: #fff; --link: #8f4b00; }
@media (prefers-color-scheme: dark) {
  :root { --ink: #e9ecf1; --muted: #98a3b4; --line: #1e2632; --ground: #090c11; --link: #ffb44a; }
  /* the figures are drawn on white */
  figure svg { filter: invert(0.94) hue-rotate(180deg); }
}
html { scroll-behavior: smooth; }
@media (prefers-reduced-motion: reduce) { html { scroll-behavior: auto; } }
body { max-width: 84rem; margin: 0 auto; padding: 2rem clamp(1rem, 4vw, 1.5rem) 5rem; background: var(--ground); color: var(--ink);
  font: 16px/1.55 system-ui, sans-serif; overflow-wrap: anywhere; }
a { color: var(--link); }
h1 { font-size: 2rem; margin: 0 0 .5rem; }
h2 { font-size: 1.3rem; line-height: 1.35; margin: 4rem 0 1rem; padding-top: 1rem; border-top: 3px solid var(--ink); }
nav h2, #summary h2 { margin-top: 2rem; padding: 0; border: 0; }
nav ol, nav ul { padding-left: 1.2rem; }
nav li { margin: .25rem 0; }
h3 { font-size: 1.1rem; margin: 2.5rem 0 .75rem; }
h4 { font-size: .8rem; text-transform: uppercase; letter-spacing: .06em; color: var(--muted); margin: 1.25rem 0 .35rem; }
header p { max-width: 60rem; }
sup { line-height: 0; font-size: .75em; }
.columns { display: grid; grid-template-columns: minmax(0, 3fr) minmax(0, 2fr); gap: 2.5rem; align-items: start; }
.paper h4:first-child { margin-top: 0; }
.paper p, .paper ul { margin: 0; }
.paper ul { padding-left: 1.1rem; }
figure { margin: 0 0 .5rem; overflow-x: auto; }
svg { display: block; width: 100%; min-width: 34rem; height: auto; }
.caption { margin: .25rem 0 1rem; color: var(--muted); font-size: .9rem; }
.scroll { overflow-x: auto; margin: .75rem 0; }
table { border-collapse: collapse; font-size: .85rem; width: 100%; font-variant-numeric: tabular-nums; overflow-wrap: normal; }
th, td { text-align: left; vertical-align: top; padding: .3rem .8rem .3rem 0; border-bottom: 1px solid var(--line); }
th { font-weight: 600; border-bottom-color: var(--muted); }
@media (max-width: 60rem) { .columns { grid-template-columns: minmax(0, 1fr); gap: 1rem; } }
";

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn powers_are_raised_and_a_full_stop_is_left() {
        assert_eq!(
            typeset("m/s^1.5 and s^-2, m^2. q < 1"),
            "m/s<sup>1.5</sup> and s<sup>-2</sup>, m<sup>2</sup>. q &lt; 1"
        );
        assert_eq!(typeset("S^T"), "S^T");
    }

    #[test]
    fn every_link_of_the_contents_leads_somewhere() {
        let mut exhibit = Exhibit { title: "Figure 1".into(), ..Exhibit::default() };
        exhibit.compare("ratio", "368.13", "368.2", "1.000");
        let html = page(&[Chapter { citation: "A paper", exhibits: vec![exhibit] }], "Text.");
        let links: Vec<&str> = html.split("href=\"#").skip(1).filter_map(|rest| rest.split('"').next()).collect();
        assert_eq!(links.len(), 3);
        assert!(links.iter().all(|link| html.contains(&format!("id=\"{link}\""))), "{links:?}");
        assert_eq!(html.matches("368.13").count(), 2);
    }
}
