"""The engine's numbers against closed forms and against numbers computed here by other means."""
