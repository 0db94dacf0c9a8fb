"""How words sound: phones, dictionaries, and rules for what no dictionary knows."""
