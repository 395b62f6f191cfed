"""The help over the picture, and the pane that shows what user code has raised."""

from __future__ import annotations

from html import escape

from PyQt5.QtCore import Qt, pyqtSignal
from PyQt5.QtGui import QFontDatabase, QFontInfo, QTextCursor
from PyQt5.QtWidgets import (
    QApplication,
    QHBoxLayout,
    QLabel,
    QPlainTextEdit,
    QPushButton,
    QSizePolicy,
    QVBoxLayout,
    QWidget,
)

from pydart2.gui.user_input import DRAGS, help_rows


class HelpOverlay(QLabel):
    """The table of keys and mouse buttons, in two columns."""

    def __init__(self, parent: QWidget) -> None:
        super().__init__(parent)
        self.setObjectName("help")
        self.setTextFormat(Qt.RichText)
        self.setText(help_html())
        self.setAttribute(Qt.WA_TransparentForMouseEvents)
        self.hide()

    def place(self) -> None:
        """In the middle of the parent, in letters that are small enough for all of it to be seen."""
        parent, font = self.parentWidget(), self.parentWidget().font()
        for size in range(font.pixelSize() if font.pixelSize() > 0 else QFontInfo(font).pixelSize(), 6, -1):
            font.setPixelSize(size)
            self.setFont(font)
            self.adjustSize()
            if self.width() <= parent.width() and self.height() <= parent.height():
                break
        self.move((parent.width() - self.width()) // 2, max((parent.height() - self.height()) // 2, 0))


def help_html() -> str:
    """The rows of `user_input` as a table."""
    rows = help_rows()
    keys = rows[len(DRAGS) :]
    half = (len(keys) + len(DRAGS)) // 2 - len(DRAGS)
    left, right = rows[: len(DRAGS) + half], rows[len(DRAGS) + half :]
    cells = []
    for i in range(max(len(left), len(right))):
        pairs = [side[i] if i < len(side) else ("", "") for side in (left, right)]
        cells.append(
            "".join(
                f'<td style="color: #9fc4f5; padding: 2px 10px 2px 0"><b>{escape(key)}</b></td>'
                f'<td style="padding: 2px 26px 2px 0">{escape(text)}</td>'
                for key, text in pairs
            )
        )
    title = '<p style="font-size: large"><b>Keys and mouse</b></p>'
    note = '<p style="color: #a9b1bc">Other keys go to the simulation’s on_key_press().</p>'
    return title + "<table>" + "".join(f"<tr>{row}</tr>" for row in cells) + "</table>" + note


class ErrorPane(QWidget):
    """A traceback, with buttons to copy and to dismiss it. Emits `dismissed`."""

    dismissed = pyqtSignal()

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.title = QLabel()
        self.title.setObjectName("error")
        self.title.setWordWrap(True)
        self.title.setSizePolicy(QSizePolicy.Ignored, QSizePolicy.Preferred)  # long words make no window wider
        self.text = QPlainTextEdit()
        self.text.setObjectName("traceback")
        self.text.setReadOnly(True)
        self.text.setLineWrapMode(QPlainTextEdit.WidgetWidth)
        self.text.setFont(QFontDatabase.systemFont(QFontDatabase.FixedFont))
        copy, dismiss = QPushButton("Copy"), QPushButton("Dismiss")
        copy.clicked.connect(lambda: QApplication.clipboard().setText(self.text.toPlainText()))
        dismiss.clicked.connect(lambda: self.dismissed.emit())
        self.copy_button, self.dismiss_button = copy, dismiss
        head = QHBoxLayout()
        head.addWidget(self.title, 1)
        head.addWidget(copy)
        head.addWidget(dismiss)
        layout = QVBoxLayout(self)
        layout.setContentsMargins(8, 6, 8, 6)
        layout.addLayout(head)
        layout.addWidget(self.text)
        self.setMaximumHeight(190)
        self.hide()

    def show_error(self, text: str) -> None:
        """Show a traceback; its last line becomes the title."""
        self.title.setText(f"Paused by an error: {text.strip().splitlines()[-1][:160]}")
        if text.rstrip() != self.text.toPlainText():
            self.text.setPlainText(text.rstrip())
        self.show()
        self.text.moveCursor(QTextCursor.End)
        self.text.moveCursor(QTextCursor.StartOfLine)
