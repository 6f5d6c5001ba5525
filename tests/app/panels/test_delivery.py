from app.panels.delivery import Delivery
from app.session.outbox import Download, EnlargePlots, LinkToCopy, Notice
from app.session.tasks import TaskState


def test_messages_are_handed_over_in_their_order(client):
    client.take_sent()
    Delivery(client).deliver(
        [
            Notice("A", "first"),
            Download("a.txt", b"content"),
            LinkToCopy("token"),
            EnlargePlots(),
            Notice("A", "2"),
        ]
    )
    assert client.notifications == ["first", "2"]
    assert client.removed == []
    assert client.downloads == [("a.txt", b"content")]
    scripts = [getattr(message, "source", "") for message in client.take_sent()]
    assert any("?link=token" in script for script in scripts)
    assert scripts[-1] == "window.tofscope.plots.enlarge();"


def test_a_sentence_about_a_file_whose_name_is_no_text_can_be_sent(client):
    Delivery(client).deliver([Notice("A", "a\udcff.mcap is empty.")])
    assert client.notifications == [r"a\udcff.mcap is empty."]


def test_a_notice_replaces_the_last_of_its_title_where_it_says_so(client):
    delivery = Delivery(client)
    delivery.deliver([Notice("A", "one", replaces=True), Notice("B", "two", replaces=True)])
    assert client.removed == []
    delivery.deliver([Notice("A", "three", replaces=True)])
    assert client.removed == ["one"]


def test_a_task_is_one_notification_until_it_has_ended(client):
    delivery = Delivery(client)
    delivery.show_tasks([TaskState("Film", "Begun.")])
    delivery.show_tasks([TaskState("Film", "Half.")])
    assert client.notifications == ["Begun."]
    assert client.removed == []
    delivery.show_tasks([])
    assert client.removed == ["Begun."]
    delivery.show_tasks([TaskState("Film", "Again.")])
    assert client.notifications == ["Begun.", "Again."]
