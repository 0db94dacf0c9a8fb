"""What a sentence does that no rule allows."""

import pytest

from hri.conversation.dialog_act import DialogAct, dialog_act


@pytest.mark.parametrize(
    ("text", "act"),
    [
        ("My neighbor bought a boat last year.", DialogAct.STATEMENT),
        ("so when i was little we had a pony", DialogAct.STATEMENT),
        ("it was a beagle", DialogAct.STATEMENT),
        ("Who wrote that book?", DialogAct.QUESTION),
        ("when is the next bus", DialogAct.QUESTION),
        ("do you know Latin", DialogAct.QUESTION_OF_ROBOT),
        ("can turtles swim", DialogAct.QUESTION),
        ("Could you tie my shoes?", DialogAct.DIRECTIVE),
        ("can i have a cookie", DialogAct.DIRECTIVE),
        ("let's play chess", DialogAct.DIRECTIVE),
        ("i want you to do the dishes", DialogAct.DIRECTIVE),
        ("do it again", DialogAct.DIRECTIVE),
        ("you have to kiss it", DialogAct.DIRECTIVE),
        ("would you rather be a cat", DialogAct.QUESTION_OF_ROBOT),
        ("Robin, should I call her?", DialogAct.QUESTION_OF_SPEAKER),
        ("where did i put my hat", DialogAct.QUESTION_WHERE),
        ("why is the sky so gray", DialogAct.QUESTION_WHY),
        ("you forgot the sound", DialogAct.STATEMENT_OF_ROBOT),
        ("that was not so great", DialogAct.REMARK),
        ("paula took my chair", DialogAct.STATEMENT),
        ("last question what do you dream about", DialogAct.QUESTION_OF_ROBOT),
        ("it's loud here so could you say it again", DialogAct.DIRECTIVE),
        ("i know what you did", DialogAct.STATEMENT),
        ("you like it don't you", DialogAct.STATEMENT_OF_ROBOT),
        ("don't get too close", DialogAct.PROHIBITION),
        ("don't you dare scratch it", DialogAct.PROHIBITION),
        ("don't you like it", DialogAct.QUESTION_OF_ROBOT),
        ("mom can i have some juice", DialogAct.CALL),
        ("leo stop kicking the wall", DialogAct.CALL),
        ("leo said no to me", DialogAct.STATEMENT),
        ("you ever get bored in here", DialogAct.QUESTION_OF_ROBOT),
        ("you know any songs", DialogAct.QUESTION_OF_ROBOT),
        ("you won't tell him right", DialogAct.QUESTION_OF_ROBOT),
        ("can't find my shoes again", DialogAct.STATEMENT),
        ("can't you see it", DialogAct.QUESTION_OF_ROBOT),
        ("theo don't sit on it", DialogAct.CALL),
        ("wait no it's the thin kind", DialogAct.CORRECTION),
        ("no i meant the blue one", DialogAct.CORRECTION),
        ("actually eleven the box says eleven", DialogAct.CORRECTION),
        ("no what time is it", DialogAct.QUESTION),
        ("no way he did that", None),
        ("do robots dream", DialogAct.QUESTION),
        ("do this for me", DialogAct.DIRECTIVE),
        ("come on tell me more", DialogAct.DIRECTIVE),
        ("mom took my phone", DialogAct.STATEMENT),
        ("have a seat", None),
        ("it was", None),
        ("purple elephants", None),
        ("so", None),
        ("", None),
    ],
)
def test_the_first_words_show_it(text, act):
    assert dialog_act(text, "Robin") is act
