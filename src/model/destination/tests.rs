use super::*;

fn list(list: Vec<Destination>) -> Result<Destinations> {
    Destinations::new(&list, 2, 4)
}

fn side(id: &str, side: f64) -> Destination {
    Destination::new(id, [1.0, 2.0]).size(side)
}

#[test]
fn a_description_is_validated_where_it_is_taken() {
    let ok = || Destination::new("a", [1.0, 2.0]).size([3.0, 4.0]);
    let covariance = [[1.0, 0.0], [0.0, 1.0]];
    let cases = [
        (
            Destination::new("b", [1.0]).size(3.0),
            "wrong-length destinations[1].center: must have 2 numbers, has 1, got [1]",
        ),
        (
            Destination::new("b", [1.0, f64::NAN]).size(3.0),
            "not-finite destinations[1].center[1]: must be a finite number, got NaN",
        ),
        (Destination::new("b", [1.0, 2.0]), "missing-key destinations[1].size: missing key \"size\""),
        (ok().size(0.0), "out-of-range destinations[1].size: must be greater than 0, got 0"),
        (ok().size([3.0, -3.0]), "out-of-range destinations[1].size[1]: must be greater than 0, got -3"),
        (ok().end_velocity(0.0), "out-of-range destinations[1].endVelocity: must be greater than 0, got 0"),
        (ok().prior(-1.0), "out-of-range destinations[1].prior: must be at least 0, got -1"),
        (ok(), "duplicate-id destinations[1].id: the id \"a\" is taken by destinations[0]"),
        (
            Destination::gaussian("b", [1.0], covariance),
            "wrong-length destinations[1].mean: must have 2 to 4 numbers, has 1, got [1]",
        ),
        (
            Destination::gaussian("b", [1.0, 2.0], [[1.0, 2.0], [2.0, 1.0]]),
            "not-positive-definite destinations[1].covariance: must be symmetric and positive definite, got [[1, 2], [2, 1]]",
        ),
        (
            Destination::gaussian("b", [1.0, 2.0], covariance).size(3.0),
            "unknown-key destinations[1].size: cannot be combined with mean and covariance, got 3",
        ),
    ];
    for (wrong, expected) in cases {
        let error = list(vec![ok(), wrong]).unwrap_err();
        assert_eq!(format!("{} {error}", error.code().as_str()), expected);
    }
    let error = Destinations::new(&[ok().end_velocity(4.0)], 2, 2).unwrap_err();
    assert_eq!(error.to_string(), "destinations[0].endVelocity: the motion model has no velocity, got 4");
}

#[test]
fn each_keeps_its_class_when_others_come_change_and_go() {
    let expect = |destinations: &Destinations, sides: &[f64]| {
        let found: Vec<f64> = (0..sides.len()).map(|i| destinations.class(i).side(0)).collect();
        assert_eq!(found, sides);
        let anew = list(sides.iter().enumerate().map(|(i, x)| side(&i.to_string(), *x)).collect()).unwrap();
        assert_eq!(destinations.classes(), anew.classes());
    };
    let mut destinations = list(vec![side("first", 5.0)]).unwrap();
    let mut sides = vec![5.0];
    for x in [5.0, 5.0, 7.0, 5.0, 7.0, 9.0] {
        destinations = destinations.with(side(&format!("{}", sides.len()), x), 4).unwrap();
        sides.push(x);
        expect(&destinations, &sides);
    }
    for (i, x) in [(6, 7.0), (0, 11.0), (3, 11.0), (5, 3.0), (6, 3.0), (1, 3.0)] {
        destinations = destinations.with_replaced(i, side(destinations.id(i), x), 4).unwrap();
        sides[i] = x;
        expect(&destinations, &sides);
    }
    while sides.len() > 1 {
        let i = sides.len() / 2;
        destinations = destinations.without(i).unwrap();
        sides.remove(i);
        expect(&destinations, &sides);
        for (i, id) in destinations.ids().enumerate() {
            assert_eq!(destinations.find(id), Some(i));
        }
    }
    assert_eq!(destinations.find("6"), None);
}

#[test]
fn a_longer_endpoint_moves_no_other() {
    let destinations = list(vec![side("a", 3.0), side("b", 3.0)]).unwrap();
    let covariance = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let destinations = destinations.with(Destination::gaussian("c", [6.0, 7.0, 8.0], covariance), 4).unwrap();
    assert_eq!([0, 1, 2].map(|i| destinations.mean(i)), [vec![1.0, 2.0], vec![1.0, 2.0], vec![6.0, 7.0, 8.0]]);
    let longest = Destination::new("a", [-1.0, -2.0]).size(3.0).end_velocity(9.0);
    let destinations = destinations.with_replaced(0, longest, 4).unwrap().without(1).unwrap();
    assert_eq!([0, 1].map(|i| destinations.mean(i)), [vec![-1.0, -2.0, 0.0, 0.0], vec![6.0, 7.0, 8.0]]);
    assert_eq!(destinations.ids().collect::<Vec<_>>(), ["a", "c"]);
}

#[test]
fn what_is_read_is_written_again() {
    let text = r#"[{"id":"a","center":[1,2],"size":[3,4],"endVelocity":5,"prior":1},
        {"id":"b","mean":[1,2],"covariance":[[1,0],[0,2]],"prior":3,"arrival":{"type":"uniform","from":1,"to":2}}]"#;
    let value: Value = serde_json::from_str(text).unwrap();
    let destinations =
        Destinations::new(&Destination::read_all(&Node::root(&value, "destinations"), 2).unwrap(), 2, 4).unwrap();
    assert_eq!(destinations.to_value(), value);
}
