//! The numbers behind the page: as JSON in one file, as CSV in one file for each figure and table.

use crate::report::{Chapter, Exhibit, Figure, Table};
use presentation::write;
use serde_json::{Value as Json, json};
use std::path::Path;

/// Everything: of each exhibit the comparisons, the tables as they are printed, and the points of every line.
pub fn json(chapters: &[Chapter]) -> Json {
    let figure = |Figure { panels, .. }: &Figure| -> Json {
        let panels = panels.iter().map(|panel| {
            let series = panel.series.iter().map(|series| json!({ "label": series.label, "points": series.points }));
            json!({ "title": panel.title, "x": panel.x.0, "y": panel.y.0, "series": series.collect::<Json>() })
        });
        panels.collect()
    };
    let comparison = |[quantity, paper, here, difference]: &[String; 4]| json!({ "quantity": quantity, "paper": paper, "here": here, "difference": difference });
    let table = |Table { headings, rows }: &Table| json!({ "headings": headings, "rows": rows });
    let exhibit = |exhibit: &Exhibit| {
        json!({
            "title": exhibit.title,
            "comparisons": exhibit.comparisons.iter().map(comparison).collect::<Json>(),
            "tables": exhibit.tables.iter().map(table).collect::<Json>(),
            "figures": exhibit.figures.iter().map(figure).collect::<Json>(),
            "assumed": exhibit.assumed,
        })
    };
    let chapter = |Chapter { citation, exhibits }: &Chapter| json!({ "citation": citation, "exhibits": exhibits.iter().map(exhibit).collect::<Json>() });
    chapters.iter().map(chapter).collect()
}

/// Writes the files into a folder, and gives their names: `comparisons.csv`, and for exhibit 1.2, as the page's contents number it,
/// `1.2-figure-1.csv` (one row a point) and `1.2-table-1.csv`.
pub fn csv(chapters: &[Chapter], folder: &Path) -> Result<Vec<String>, String> {
    let mut names = Vec::new();
    let mut save = |name: String, rows: &[Vec<String>]| -> Result<(), String> {
        write(&folder.join(&name), &lines(rows)?)?;
        names.push(name);
        Ok(())
    };
    let mut comparisons = vec![row(["exhibit", "quantity", "paper", "here", "difference"])];
    for (number, chapter) in (1..).zip(chapters) {
        for (place, exhibit) in (1..).zip(&chapter.exhibits) {
            let id = format!("{number}.{place}");
            comparisons
                .extend(exhibit.comparisons.iter().map(|cells| [std::slice::from_ref(&id), &cells[..]].concat()));
            for (k, figure) in (1..).zip(&exhibit.figures) {
                save(format!("{id}-figure-{k}.csv"), &points(figure))?;
            }
            for (k, Table { headings, rows }) in (1..).zip(&exhibit.tables) {
                save(format!("{id}-table-{k}.csv"), &[std::slice::from_ref(headings), &rows[..]].concat())?;
            }
        }
    }
    save("comparisons.csv".to_owned(), &comparisons)?;
    Ok(names)
}

/// A row for each point of each line.
fn points(figure: &Figure) -> Vec<Vec<String>> {
    let mut rows = vec![row(["panel", "line", "label", "x", "y"])];
    for (place, panel) in (1..).zip(&figure.panels) {
        let title = if panel.title.is_empty() { place.to_string() } else { panel.title.clone() };
        for (line, series) in (1..).zip(&panel.series) {
            for (x, y) in &series.points {
                rows.push(vec![title.clone(), line.to_string(), series.label.clone(), x.to_string(), y.to_string()]);
            }
        }
    }
    rows
}

fn row(cells: [&str; 5]) -> Vec<String> {
    cells.map(str::to_owned).to_vec()
}

fn lines(rows: &[Vec<String>]) -> Result<String, String> {
    let mut writer = csv::WriterBuilder::new().flexible(true).from_writer(Vec::new());
    for cells in rows {
        writer.write_record(cells).map_err(|error| error.to_string())?;
    }
    let bytes = writer.into_inner().map_err(|error| error.to_string())?;
    String::from_utf8(bytes).map_err(|error| error.to_string())
}

#[cfg(test)]
mod tests {
    use super::*;
    use presentation::{COLOURS, Corner, Panel, Series};

    fn chapters() -> Vec<Chapter> {
        let series = vec![Series::new("a, b", COLOURS[0], [(0.0, 0.1 + 0.2), (1.0, 2.0)])];
        let panel = Panel {
            title: String::new(),
            x: ("x", 0.0..1.0),
            y: ("y", 0.0..2.0),
            legend: Some(Corner::UpperLeft),
            series,
        };
        let mut table = Table::new(&["method", "time"]);
        table.row(["one", "63%"]);
        let mut exhibit = Exhibit {
            title: "Figure 1".into(),
            figures: vec![Figure::new([panel], 1, (300, 200))],
            ..Exhibit::default()
        };
        exhibit.tables.push(table);
        exhibit.compare("ratio", "368.13", "368.2", "1.000");
        vec![Chapter { citation: "A paper", exhibits: vec![exhibit] }]
    }

    #[test]
    fn json_has_every_number() {
        let all = json(&chapters());
        let exhibit = &all[0]["exhibits"][0];
        assert_eq!(exhibit["figures"][0][0]["series"][0]["points"][0], json!([0.0, 0.1 + 0.2]));
        assert_eq!(exhibit["comparisons"][0]["paper"], "368.13");
        assert_eq!(exhibit["tables"][0]["rows"][0][1], "63%");
    }

    #[test]
    fn csv_has_a_file_for_each_figure_and_table() {
        let folder = std::env::temp_dir().join(format!("whither-reproduce-{}", std::process::id()));
        let names = csv(&chapters(), &folder).unwrap();
        assert_eq!(names, ["1.1-figure-1.csv", "1.1-table-1.csv", "comparisons.csv"]);
        let text = |name: &str| std::fs::read_to_string(folder.join(name)).unwrap();
        assert_eq!(text(&names[0]), "panel,line,label,x,y\n1,1,\"a, b\",0,0.30000000000000004\n1,1,\"a, b\",1,2\n");
        assert_eq!(text(&names[1]), "method,time\none,63%\n");
        assert_eq!(text(&names[2]), "exhibit,quantity,paper,here,difference\n1.1,ratio,368.13,368.2,1.000\n");
        std::fs::remove_dir_all(&folder).unwrap();
    }
}
