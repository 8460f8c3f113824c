//! Several browsers at once.

use serde_json::json;

use super::Running;

/// Each act of each of them is there in the end.
#[test]
fn ten_clients_at_once_lose_nothing() {
    let studio = Running::of("thrown_ball_drag.json");
    std::thread::scope(|scope| {
        for client in 0..10 {
            let studio = &studio;
            scope.spawn(move || {
                for round in 0..2 {
                    let observation = 2 * client + round;
                    // Neighbours of the collision have to stay.
                    let observation = if observation < 10 { observation } else { observation + 13 };
                    let action = json!({"do": "mark", "body": "ball", "observation": observation, "wrong": true});
                    let state = studio.act(action);
                    let current = state["current"].as_u64().unwrap() as usize;
                    assert_eq!(
                        state["variants"][current]["did"],
                        format!("pose {observation} of ball marked wrong")
                    );
                    studio.state();
                    studio.post("api/law", &json!({"draft": format!("{client}")}).to_string()).json();
                }
            });
        }
    });
    let state = studio.state();
    assert_eq!(state["edits"]["marked"].as_array().unwrap().len(), 20);
    assert_eq!(state["variants"].as_array().unwrap().len(), 21);
    let again = studio.again().state();
    assert_eq!(again["variants"], state["variants"]);
}
